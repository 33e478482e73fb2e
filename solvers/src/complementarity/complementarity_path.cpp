#include "complementarity/complementarity_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "balance/active_block.hpp"
#include "linalg/dense.hpp"

namespace wavebalance::solvers {
namespace {

// Each update of the inverse loses accuracy. After this many it is computed anew; large ones, which cost
// more, less often.
Eigen::Index most_updates(Eigen::Index size) { return std::max<Eigen::Index>(50, 2 * size); }

// Force and slope are recomputed from the whole inverse every so many pivots, to remove accumulated rounding.
constexpr int pivots_per_correction = 8;

}  // namespace

ComplementarityPath::ComplementarityPath(CondensedProblem& problem)
    : problem_(problem), inverse_(problem.samples()), max_segment_(10 * problem.samples()) {}

// K is invariant under shifts by the shift period. The column of a point is therefore that of the point
// modulo the period, with the rows shifted by the remaining points.
double ComplementarityPath::entry(int row, int column) const {
  const int points = problem_.points(), period = problem_.pair().shift_period();
  const int remainder = column % points % period;
  int point = row % points - (column % points - remainder);
  if (point < 0) point += points;
  const double k = problem_.columns()(row - row % points + point, column / points * period + remainder);
  return row == column ? k + state_.obstacles.flexibility[row] : k;
}

Eigen::MatrixXd ComplementarityPath::block(const std::vector<int>& samples) const {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd result(n, n);
  fill_active_compliance(problem_, samples, result);
  result.diagonal() += state_.obstacles.flexibility(samples);
  return result;
}

void ComplementarityPath::invert(const std::vector<int>& samples) {
  inverse_.assign(samples, detail::Lu<double>(block(samples)).inverse());
  const auto n = static_cast<double>(samples.size());
  operations_ -= 2.0 * n * n * n;
}

double ComplementarityPath::condition() {
  if (inverse_.size() == 0) return 1.0;
  const auto norm = [](const auto& matrix) { return matrix.cwiseAbs().colwise().sum().maxCoeff(); };
  const double inverse = norm(inverse_.matrix());
  return norm(block(inverse_.ascending())) * inverse;
}

void ComplementarityPath::pivot_at(int sample) {
  inverse_.apply_pending_updates();
  const auto n = static_cast<double>(inverse_.size());
  if (inverse_.contains(sample)) {
    operations_ -= 2.0 * n * n;
    leave(sample);
  } else {
    operations_ -= 6.0 * n * n;
    enter(sample);
  }
}

void ComplementarityPath::enter(int sample) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(inverse_.size()), row = column;
  for (Eigen::Index i = 0; i < inverse_.size(); ++i) {
    const int member = inverse_.members()[static_cast<std::size_t>(i)];
    if (member < 0) continue;
    column[i] = entry(member, sample);
    row[i] = entry(sample, member);
  }
  const Eigen::VectorXd right = inverse_.times(column), left = inverse_.transposed_times(row);
  const double pivot = entry(sample, sample) - row.dot(right);
  const double slope = (covering_vector_[sample] - row.dot(inverse_.gather(slope_))) / pivot;
  subtract(slope * right, slope_);
  slope_[sample] = slope;
  inverse_.enter(sample, right, left, pivot);
}

void ComplementarityPath::leave(int sample) {
  const Eigen::VectorXd column = inverse_.leave(sample);
  subtract(slope_[sample] * column, slope_);
  slope_[sample] = state_.force[sample] = distance_[sample] = 0.0;
}

// Subtracts `values`, indexed by slot of the inverse, from `all`, indexed by sample.
void ComplementarityPath::subtract(const Eigen::VectorXd& values, Eigen::VectorXd& all) const {
  for (Eigen::Index slot = 0; slot < inverse_.size(); ++slot)
    if (const int member = inverse_.members()[static_cast<std::size_t>(slot)]; member >= 0)
      all[member] -= values[slot];
}

void ComplementarityPath::measure() {
  const Obstacles& obstacles = state_.obstacles;
  problem_.apply(state_.force, product_);
  distance_ = obstacles.gap_without_force + z_ * covering_vector_ +
              obstacles.flexibility.cwiseProduct(state_.force) + product_;
}

// One step of iterative refinement for the force and for its derivative.
void ComplementarityPath::correct() {
  if (inverse_.updates() > most_updates(inverse_.size())) invert(inverse_.ascending());
  measure();
  Eigen::MatrixXd right(inverse_.size(), 2);
  right.col(0) = inverse_.gather(distance_);
  right.col(1) = inverse_.gather(covering_vector_);
  const Eigen::MatrixXd found = inverse_.times(right);
  operations_ -= 4.0 * double(inverse_.size()) * double(inverse_.size());
  subtract(found.col(0), state_.force);
  slope_.setZero(covering_vector_.size());
  subtract(-found.col(1), slope_);
  keep_in_contact(distance_);
}

// Sets the distance to zero at the samples in contact.
void ComplementarityPath::keep_in_contact(Eigen::VectorXd& distance) const {
  for (const int member : inverse_.members())
    if (member >= 0) distance[member] = 0.0;
}

// Ends a segment: accepts the solution if the distances hold to rounding of the terms they are sums of.
ComplementarityPath::End ComplementarityPath::finish() {
  constexpr double rounding = 1e-10;
  correct();
  state_.active = inverse_.ascending();
  state_.force = state_.force.cwiseMax(0.0);
  measure();
  double size = product_.cwiseAbs().maxCoeff(), worst = 0.0;
  for (Eigen::Index l = 0; l < distance_.size(); ++l) {
    const double gap_without_force = std::abs(state_.obstacles.gap_without_force[l]);
    if (std::isfinite(gap_without_force)) size = std::max(size, gap_without_force);
    worst = std::max(worst, state_.force[l] > 0.0 ? std::abs(distance_[l]) : -distance_[l]);
  }
  return std::isfinite(size) && worst <= rounding * size ? End::reached : End::lost;
}

// Derivatives with respect to z; the sign is such that the pivoted sample leaves its bound.
void ComplementarityPath::set_rates(int pivoted) {
  force_rate_ = -slope_;
  problem_.apply(force_rate_, product_);
  distance_rate_ = covering_vector_ + state_.obstacles.flexibility.cwiseProduct(force_rate_) + product_;
  keep_in_contact(distance_rate_);
  if (pivoted >= 0) {
    const bool presses = inverse_.contains(pivoted);
    direction_ = (presses ? force_rate_[pivoted] : distance_rate_[pivoted]) > 0.0 ? 1.0 : -1.0;
  }
  force_rate_ *= direction_;
  distance_rate_ *= direction_;
}

// The sample that reaches its bound first, and the length up to there; -1 if z = 0 is reached before, or if
// no sample reaches its bound.
int ComplementarityPath::next_pivot(double& length) const {
  int sample = -1;
  length = direction_ < 0.0 ? z_ : std::numeric_limits<double>::infinity();
  for (int l = 0; l < state_.force.size(); ++l) {
    const bool presses = inverse_.contains(l);
    const double rate = presses ? force_rate_[l] : distance_rate_[l];
    if (!(rate < 0.0)) continue;
    const double ahead = std::max(0.0, presses ? state_.force[l] : distance_[l]) / -rate;
    if (ahead >= length) continue;
    length = ahead;
    sample = l;
  }
  return sample;
}

ComplementarityPath::End ComplementarityPath::follow_segment(int sample) {
  for (int pivot = 0; pivot < max_segment_ && operations_ > 0.0; ++pivot, ++pivots_) {
    if (sample >= 0) pivot_at(sample);
    if (pivot % pivots_per_correction == 0) correct();
    set_rates(sample);
    double length = 0.0;
    sample = next_pivot(length);
    operations_ -= 300.0 * double(state_.force.size());  // transforms, at a fraction of the rate of products
    if (!std::isfinite(length) || !state_.force.allFinite()) return End::ray;
    state_.force += length * force_rate_;
    distance_ += length * distance_rate_;
    z_ = sample < 0 ? 0.0 : z_ + length * direction_;
    if (sample < 0) return finish();
    if (observer_ && !observer_(z_ / first_z_)) return End::cancelled;
  }
  return End::effort_limit;
}

ComplementarityPath::End ComplementarityPath::lower(Obstacles goal, const Eigen::VectorXd& covering_vector) {
  state_ = {std::move(goal), {}, Eigen::VectorXd::Zero(covering_vector.size())};
  covering_vector_ = covering_vector;
  inverse_.assign({}, Eigen::MatrixXd());
  slope_.setZero(covering_vector.size());
  distance_.setZero(covering_vector.size());
  direction_ = -1.0;
  int sample = 0;
  z_ = first_z_ = (-state_.obstacles.gap_without_force.cwiseQuotient(covering_vector_)).maxCoeff(&sample);
  return z_ > 0.0 ? follow_segment(sample) : End::reached;
}

ComplementarityPath::End ComplementarityPath::follow(Obstacles goal) {
  covering_vector_ = (state_.obstacles.flexibility - goal.flexibility).cwiseProduct(state_.force);
  // Both gaps are infinite where there is no obstacle.
  for (Eigen::Index l = 0; l < covering_vector_.size(); ++l)
    if (std::isfinite(goal.gap_without_force[l]))
      covering_vector_[l] += state_.obstacles.gap_without_force[l] - goal.gap_without_force[l];
  state_.obstacles = std::move(goal);
  z_ = first_z_ = 1.0;
  direction_ = -1.0;
  invert(state_.active);
  return follow_segment(-1);
}

}  // namespace wavebalance::solvers
