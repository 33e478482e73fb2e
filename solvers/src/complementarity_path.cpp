#include "complementarity_path.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "active_block.hpp"

namespace wavebalance::solvers {
namespace {

// An update of the inverse loses digits: it is made anew after this many, more where that is dear.
Eigen::Index most_updates(Eigen::Index size) { return std::max<Eigen::Index>(50, size / 2); }

}  // namespace

ComplementarityPath::ComplementarityPath(CondensedProblem& problem)
    : problem_(problem), corners_a_leg_(10 * problem.samples()), operations_(1e10) {}

// The column of a point is that of the point modulo the shift period, shifted by the rest.
double ComplementarityPath::entry(int row, int column) const {
  const int points = problem_.points(), period = problem_.pair().shift_period();
  const int remainder = column % points % period;
  int point = row % points - (column % points - remainder);
  if (point < 0) point += points;
  const double k = problem_.columns()(row - row % points + point, column / points * period + remainder);
  return row == column ? k + state_.obstacles.flexibility[row] : k;
}

Eigen::MatrixXd ComplementarityPath::block() const {
  Eigen::MatrixXd result(count(), count());
  fill_active_compliance(problem_, state_.active, result);
  result.diagonal() += state_.obstacles.flexibility(state_.active);
  return result;
}

void ComplementarityPath::invert() {
  updates_ = 0;
  const Eigen::Index n = count();
  if (n == 0) return;
  if (inverse_.rows() < n) inverse_.resize(2 * n, 2 * n);
  inverse() = block().partialPivLu().inverse();
  operations_ -= 0.5 * double(n) * double(n) * double(n);  // blocked, at several times the rate of updates
}

double ComplementarityPath::condition() {
  if (count() == 0) return 1.0;
  const auto norm = [](const auto& matrix) { return matrix.cwiseAbs().colwise().sum().maxCoeff(); };
  return norm(block()) * norm(inverse());
}

// The inverse of the bordered block by its Schur complement.
void ComplementarityPath::enter(int sample) {
  const Eigen::Index n = count();
  if (inverse_.rows() <= n) inverse_.conservativeResize(2 * n + 16, 2 * n + 16);
  Eigen::VectorXd column(n), row(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    column[i] = entry(state_.active[static_cast<std::size_t>(i)], sample);
    row[i] = entry(sample, state_.active[static_cast<std::size_t>(i)]);
  }
  const Eigen::VectorXd right = inverse() * column, left = inverse().transpose() * row;
  const double pivot = entry(sample, sample) - row.dot(right);
  inverse().noalias() += (right / pivot) * left.transpose();
  inverse_.col(n).head(n) = -right / pivot;
  inverse_.row(n).head(n) = -left.transpose() / pivot;
  inverse_(n, n) = 1.0 / pivot;
  state_.place[static_cast<std::size_t>(sample)] = static_cast<int>(n);
  state_.active.push_back(sample);
  ++updates_;
}

void ComplementarityPath::leave(int sample) {
  const Eigen::Index n = count(), last = n - 1;
  int& place = state_.place[static_cast<std::size_t>(sample)];
  if (place != last) {
    inverse_.col(place).head(n).swap(inverse_.col(last).head(n));
    inverse_.row(place).head(n).swap(inverse_.row(last).head(n));
    state_.active[static_cast<std::size_t>(place)] = state_.active.back();
    state_.place[static_cast<std::size_t>(state_.active.back())] = place;
  }
  state_.active.pop_back();
  place = -1;
  state_.force[sample] = 0.0;
  const Eigen::VectorXd column = inverse_.col(last).head(last) / inverse_(last, last);
  const Eigen::RowVectorXd row = inverse_.row(last).head(last);
  inverse().noalias() -= column * row;
  ++updates_;
}

void ComplementarityPath::measure() {
  const Obstacles& obstacles = state_.obstacles;
  problem_.apply(state_.force, product_);
  distance_ = obstacles.opening + z_ * cover_ + obstacles.flexibility.cwiseProduct(state_.force) + product_;
}

// Takes from the force what it leaves of a distance in contact.
void ComplementarityPath::correct() {
  if (updates_ > most_updates(count())) invert();
  measure();
  const Eigen::VectorXd left = distance_(state_.active);
  state_.force(state_.active) -= inverse() * left;
  distance_(state_.active).setZero();
}

// At the end of a leg, to rounding of the terms that make a distance.
bool ComplementarityPath::holds() {
  constexpr double rounding = 1e-10;
  state_.force = state_.force.cwiseMax(0.0);
  measure();
  double size = product_.cwiseAbs().maxCoeff(), worst = 0.0;
  for (Eigen::Index l = 0; l < distance_.size(); ++l) {
    const double opening = std::abs(state_.obstacles.opening[l]);
    if (std::isfinite(opening)) size = std::max(size, opening);
    worst = std::max(worst, state_.force[l] > 0.0 ? std::abs(distance_[l]) : -distance_[l]);
  }
  return std::isfinite(size) && worst <= rounding * size;
}

// By z, in the direction in which the sample that has just turned goes away from its bound.
void ComplementarityPath::set_rates(int turned) {
  const Eigen::VectorXd raised = cover_(state_.active);
  force_rate_.setZero(state_.force.size());
  force_rate_(state_.active) = -(inverse() * raised);
  problem_.apply(force_rate_, product_);
  distance_rate_ = cover_ + state_.obstacles.flexibility.cwiseProduct(force_rate_) + product_;
  distance_rate_(state_.active).setZero();
  if (turned >= 0) {
    const bool presses = state_.place[static_cast<std::size_t>(turned)] >= 0;
    direction_ = (presses ? force_rate_[turned] : distance_rate_[turned]) > 0.0 ? 1.0 : -1.0;
  }
  force_rate_ *= direction_;
  distance_rate_ *= direction_;
}

// The sample that reaches its bound first and the length up to there; -1 when z = 0 comes before, or nothing.
int ComplementarityPath::next_corner(double& length) const {
  int sample = -1;
  length = direction_ < 0.0 ? z_ : std::numeric_limits<double>::infinity();
  for (int l = 0; l < state_.force.size(); ++l) {
    const bool presses = state_.place[static_cast<std::size_t>(l)] >= 0;
    const double rate = presses ? force_rate_[l] : distance_rate_[l];
    if (!(rate < 0.0)) continue;
    const double ahead = std::max(0.0, presses ? state_.force[l] : distance_[l]) / -rate;
    if (ahead >= length) continue;
    length = ahead;
    sample = l;
  }
  return sample;
}

ComplementarityPath::End ComplementarityPath::run(int sample) {
  for (int corner = 0; corner < corners_a_leg_ && operations_ > 0.0; ++corner, ++corners_) {
    if (sample >= 0) state_.place[static_cast<std::size_t>(sample)] < 0 ? enter(sample) : leave(sample);
    correct();
    set_rates(sample);
    double length = 0.0;
    sample = next_corner(length);
    operations_ -= 10.0 * double(count()) * double(count()) + 100.0 * double(state_.force.size());
    if (!std::isfinite(length) || !state_.force.allFinite()) return End::ray;
    state_.force += length * force_rate_;
    z_ = sample < 0 ? 0.0 : z_ + length * direction_;
    if (sample < 0) return holds() ? End::reached : End::lost;
    if (observer_ && !observer_(z_ / first_z_)) return End::stopped;
  }
  return End::limit;
}

ComplementarityPath::End ComplementarityPath::lower(Obstacles goal, const Eigen::VectorXd& cover) {
  state_.obstacles = std::move(goal);
  cover_ = cover;
  state_.active.clear();
  state_.place.assign(static_cast<std::size_t>(cover.size()), -1);
  state_.force.setZero(cover.size());
  updates_ = 0;
  direction_ = -1.0;
  int sample = 0;
  z_ = first_z_ = (-state_.obstacles.opening.cwiseQuotient(cover_)).maxCoeff(&sample);
  return z_ > 0.0 ? run(sample) : End::reached;
}

ComplementarityPath::End ComplementarityPath::follow(Obstacles goal) {
  cover_ = (state_.obstacles.flexibility - goal.flexibility).cwiseProduct(state_.force);
  for (Eigen::Index l = 0; l < cover_.size(); ++l)  // where there is no obstacle both are infinite
    if (std::isfinite(goal.opening[l])) cover_[l] += state_.obstacles.opening[l] - goal.opening[l];
  state_.obstacles = std::move(goal);
  z_ = first_z_ = 1.0;
  direction_ = -1.0;
  invert();
  return run(-1);
}

}  // namespace wavebalance::solvers
