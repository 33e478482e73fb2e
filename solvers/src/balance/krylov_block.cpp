#include "balance/krylov_block.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace wavebalance::solvers {
namespace {

constexpr int max_iterations = 200;

// The same with a preconditioner of a state before, after which it is made anew.
constexpr int max_kept_iterations = 40;

// GMRES starts anew from the true residual where rounding has separated it from the one that it updates.
constexpr int max_refinements = 2;

// As many directions are kept as are needed for |D(n)| ||H(n)|| <= largest_remainder beyond them, up to a
// limit, D(n) the slopes of the forces by a motion of harmonic n. This bounds J - P, and with it the number
// of iterations.
constexpr double largest_remainder = 0.25;

// The dense system of the preconditioner of one contact costs as much as one product with K at 4 N^(1/3)
// unknowns, and as much as a solve of about twenty iterations at three times that. Products of many contacts
// grow like C^2 N, and with them the size that is worth its cost.
CoarseSize coarse_size(int contacts, const PeriodSlopes& slopes, double frequency) {
  const auto samples = double(slopes.displacement.size());
  const auto largest = [](const Eigen::VectorXd& all) {
    return all.size() > 0 ? all.cwiseAbs().maxCoeff() : 0.0;
  };
  return {static_cast<Eigen::Index>(4.0 * std::cbrt(samples)),
          static_cast<Eigen::Index>(12.0 * std::cbrt(samples * contacts)), largest_remainder,
          largest(slopes.displacement), 2.0 * std::numbers::pi * frequency * largest(slopes.velocity)};
}

}  // namespace

// Operations of a preconditioner over the operations of an iteration, whose products with K wait for
// memory.
double KrylovBlock::iterations_of_renewal(const ContactOperator& contact) const {
  constexpr double of_kernel = 24.0, of_samples = 400.0;
  const CondensedProblem& problem = contact.problem();
  const double size = double(coarse_.size()), contacts = problem.contacts();
  const double renewal = size * size * (size / 1.5 + 4.0 * contacts) + 8.0 * contacts * contacts * size;
  const double iteration = of_kernel * contacts * contacts * problem.pair().spectrum_size() +
                           of_samples * contacts * problem.points() + 2.0 * size * size;
  return renewal / iteration;
}

bool KrylovBlock::may_be_kept(const ContactOperator& contact) const {
  constexpr int many_contacts = 50;  // for fewer a new one is cheap
  if (contact.problem().contacts() <= many_contacts) return false;
  constexpr double least_worth = 4.0, share = 0.5;  // of a renewal, allowed for more iterations
  constexpr double most = 2.0;                      // by which slopes may have grown or fallen
  const double slopes = active_->scale().norm();
  if (!(slopes <= most * made_slopes_) || !(most * slopes >= made_slopes_)) return false;
  if (!made_ || border_.exists() != made_with_border_ || iterations_ > max_kept_iterations) return false;
  const double worth = iterations_of_renewal(contact);
  return worth >= least_worth && iterations_ - least_iterations_ <= share * worth;
}

bool KrylovBlock::renew() {
  ++renewals_;
  set_coarse(*contact_, *slopes_);
  const Eigen::Index size = coarse_.size() + (border_.exists() ? 1 : 0);
  matrix_.resize(size, size);
  coarse_.fill(*slopes_, contact_->problem().frequency(), matrix_);
  if (border_.exists()) {
    active_->write(active_column_, weighted_);
    coarse_.respond(weighted_, coefficients_);
    matrix_.col(size - 1).head(size - 1) = coefficients_;
    matrix_.row(size - 1) = border_row().transpose();
  }
  lu_.compute(matrix_);
  made_ = !lu_.is_singular();
  made_with_border_ = border_.exists();
  made_slopes_ = active_->scale().norm();
  kept_ = false;
  iterations_ = 0;
  least_iterations_ = max_iterations;
  return made_;
}

// Choosing the directions of many contacts costs as much as solving with them. They are chosen again at
// each frequency, because the sign of the preconditioner's determinant is used as the sign of det J.
void KrylovBlock::set_coarse(ContactOperator& contact, const PeriodSlopes& slopes) {
  const double frequency = contact.problem().frequency();
  const CoarseSize wanted = coarse_size(contact.problem().contacts(), slopes, frequency);
  if (frequency == coarse_frequency_ && wanted == coarse_wanted_) return;
  const auto harmonics = std::min<Eigen::Index>((contact.problem().points() - 1) / 2, wanted.largest / 2);
  coarse_.set(contact, static_cast<int>(harmonics), wanted);
  coarse_frequency_ = frequency;
  coarse_wanted_ = wanted;
}

bool KrylovBlock::factorize(ContactOperator& contact, ActiveSlopes& active, const PeriodSlopes& slopes,
                            Border border) {
  contact_ = &contact;
  active_ = &active;
  slopes_ = &slopes;
  border_ = std::move(border);
  weighted_.setZero(slopes.displacement.size());
  largest_gain_ = smallest_gain_ = 0.0;
  if (!std::isfinite(active.scale().squaredNorm())) return false;
  if (border_.exists()) read_border();
  return (may_be_kept(contact) && keep()) || renew();
}

void KrylovBlock::read_border() {
  contact_->apply_transposed(border_.row, samples_);
  active_row_ = -samples_(active_->samples()).cwiseProduct(active_->scale());
  active_column_ = active_->read(border_.column);
}

// With x = r - K S z - b y the last row is -(S K^T c).z + (d - c.b) y = s - c.r. With the preconditioner's
// z = v - B (U g + b y) it becomes an equation for y and g = V S z.
Eigen::VectorXd KrylovBlock::border_row() {
  coarse_.analyse(active_->read_transposed(active_row_, weighted_.size()), coefficients_);
  Eigen::VectorXd row = -coefficients_;
  row.conservativeResize(coarse_.size() + 1);
  row[coarse_.size()] = border_.corner - border_.row.dot(border_.column) - active_row_.dot(active_column_);
  return row;
}

// Only the last row of the previous state is replaced: a rank-one change of its LU.
bool KrylovBlock::keep() {
  kept_ = true;
  if (!border_.exists()) return true;
  const Eigen::Index last = coarse_.size();
  row_change_ = border_row() - matrix_.row(last).transpose();
  row_influence_ = lu_.solve(Eigen::VectorXd(Eigen::VectorXd::Unit(last + 1, last)));
  row_pivot_ = 1.0 + row_change_.dot(row_influence_);
  constexpr double least = 1e-6;
  return std::abs(row_pivot_) > least * (1.0 + row_change_.norm() * row_influence_.norm());
}

Eigen::VectorXd KrylovBlock::solve_coarse(const Eigen::VectorXd& right) const {
  Eigen::VectorXd solution = lu_.solve(right);
  if (kept_ && border_.exists()) solution -= row_change_.dot(solution) / row_pivot_ * row_influence_;
  return solution;
}

int KrylovBlock::determinant_sign() {
  if (kept_) renew();
  return lu_.determinant_sign();
}

// (z, y) = P^-1 (v, s).
void KrylovBlock::precondition(const Eigen::VectorXd& v, double s, Unknown& unknown) {
  active_->write(v, weighted_);
  coarse_.respond(weighted_, coefficients_);
  if (border_.exists()) {
    coefficients_.conservativeResize(coarse_.size() + 1);
    coefficients_[coarse_.size()] = s - active_row_.dot(v);
  }
  const Eigen::VectorXd solution = solve_coarse(coefficients_);
  coarse_.synthesise(solution, samples_);
  unknown.z = v - active_->read(samples_);
  unknown.y = border_.exists() ? solution[coarse_.size()] : 0.0;
  if (border_.exists()) unknown.z -= unknown.y * active_column_;
}

// z + B (K S z + b y).
void KrylovBlock::multiply(ContactOperator& contact, const Unknown& unknown, Eigen::VectorXd& product) {
  active_->write(unknown.z, weighted_);
  contact.apply(weighted_, samples_);
  product = unknown.z + active_->read(samples_);
  const double gain = product.norm() / unknown.z.norm();
  if (std::isfinite(gain)) {
    largest_gain_ = std::max(largest_gain_, gain);
    smallest_gain_ = smallest_gain_ > 0.0 ? std::min(smallest_gain_, gain) : gain;
  }
  if (border_.exists()) product += unknown.y * active_column_;
}

// P contains the last row of the bordered system exactly, so that after P^-1 (r, s) only the others have a
// residual. At a fold of a curve r - b y vanishes for the tangent, whose size is then the size of the
// terms.
double KrylovBlock::size_of_terms(double right, const Eigen::VectorXd& z) const {
  return border_.exists() ? std::max(right, z.norm()) : right;
}

KrylovBlock::Outcome KrylovBlock::solve_active(ContactOperator& contact, const Eigen::VectorXd& r, double s,
                                               double reduction, Unknown& unknown) {
  precondition(r, s, unknown);
  Unknown step;
  const auto map = [&](const Eigen::VectorXd& v, Eigen::VectorXd& image) {
    precondition(v, 0.0, step);
    multiply(contact, step, image);
  };
  Outcome outcome;
  Eigen::VectorXd product, v;
  for (int round = 0; round <= max_refinements; ++round) {
    multiply(contact, unknown, product);
    const Eigen::VectorXd remainder = r - product;
    const double right = border_.exists() ? (r - unknown.y * active_column_).norm() : r.norm();
    const double size = size_of_terms(right, unknown.z);
    outcome.solved = !(size > 0.0) || remainder.norm() / size <= reduction;
    if (outcome.solved || round == max_refinements) break;
    const GmresResult found =
        gmres(map, remainder, 0.5 * reduction * size, kept_ ? max_kept_iterations : max_iterations, v);
    outcome.iterations += found.iterations;
    if (found.iterations == 0 || !v.allFinite()) break;
    precondition(v, 0.0, step);
    unknown.z += step.z;
    unknown.y += step.y;
    if (!found.solved) break;
  }
  return outcome;
}

// B x = B (r - K S z) differs from z by the residual. If B selects samples, x = z is used there, because K
// D would magnify the residual.
void KrylovBlock::complete(ContactOperator& contact, const Eigen::VectorXd& r, double reduction,
                           const Eigen::VectorXd& z, Eigen::VectorXd& x, Outcome& outcome) {
  active_->write(z, weighted_);
  contact.apply(weighted_, x);
  const double product = x.norm();
  x = r - x;
  const double size = size_of_terms(active_->read(r).norm(), z), residual = (active_->read(x) - z).norm();
  if (active_->takes_samples()) x(active_->samples()) = z;
  // The residual that GMRES updates differs from the true one when J is nearly singular.
  constexpr double rounding = 1e-13, drift = 2.0;
  outcome.solved = outcome.solved && residual <= drift * reduction * size + rounding * (product + r.norm());
}

KrylovBlock::Outcome KrylovBlock::solve(ContactOperator& contact, const Eigen::VectorXd& r, double s,
                                        double reduction, Eigen::VectorXd& x, double& y) {
  y = 0.0;
  Eigen::VectorXd reduced = r;
  if (active_->count() == 0 && !border_.exists()) {
    x = std::move(reduced);
    return {true, 0};
  }
  Unknown unknown;
  const double last = border_.exists() ? s - border_.row.dot(r) : 0.0;
  Outcome outcome = solve_active(contact, active_->read(r), last, reduction, unknown);
  y = unknown.y;
  if (border_.exists()) reduced -= y * border_.column;
  complete(contact, reduced, reduction, unknown.z, x, outcome);
  if (!outcome.solved && kept_ && renew()) {
    const int before = outcome.iterations;
    outcome = solve(contact, r, s, reduction, x, y);
    outcome.iterations += before;
    return outcome;
  }
  iterations_ = outcome.iterations;
  least_iterations_ = std::min(least_iterations_, iterations_);
  return outcome;
}

// Power iteration on J estimates the largest singular value, on P^-1 the smallest. Both
// start from a vector with all frequencies, because the smallest singular value may belong to a smooth
// motion.
double KrylovBlock::condition(ContactOperator& contact) {
  if (active_->count() == 0) return 1.0;
  Unknown unknown;
  Eigen::VectorXd product;
  const Eigen::ArrayXd samples =
      Eigen::ArrayXd::LinSpaced(active_->count(), 0.0, double(active_->count()) - 1.0);
  const Eigen::VectorXd all_frequencies = samples.square().cos().matrix();
  unknown.z = (1.0 + all_frequencies.array()).matrix();
  multiply(contact, unknown, product);
  if (!border_.exists()) {
    unknown.z = product.normalized();
    multiply(contact, unknown, product);
    precondition(all_frequencies, 0.0, unknown);
    const Eigen::VectorXd shrunk = unknown.z.normalized();
    precondition(shrunk, 0.0, unknown);
    multiply(contact, unknown, product);
  }
  return smallest_gain_ > 0.0 ? largest_gain_ / smallest_gain_ : 1.0;
}

}  // namespace wavebalance::solvers
