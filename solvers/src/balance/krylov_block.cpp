#include "balance/krylov_block.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::solvers {
namespace {

constexpr int max_iterations = 200;

// GMRES starts anew from the true residual where rounding has separated it from the one that it updates.
constexpr int max_refinements = 2;

// As many directions are kept as are needed for |D| ||H(n)|| <= largest_remainder beyond them, up to a limit.
// This bounds J - P, and with it the number of iterations.
constexpr double largest_remainder = 0.25;

// The dense system of the preconditioner costs as much as one product with K at 4 N^(1/3) unknowns, and as
// much as a solve of about twenty iterations at three times that.
CoarseSize coarse_size(Eigen::Index samples, double largest_tangent) {
  const auto balanced = static_cast<Eigen::Index>(4.0 * std::cbrt(double(samples)));
  const double remainder = largest_tangent > 0.0 ? largest_remainder / largest_tangent : 1.0;
  return {balanced, 3 * balanced, remainder};
}

}  // namespace

Eigen::VectorXd KrylovBlock::gather(const Eigen::VectorXd& samples) const { return samples(active_); }

void KrylovBlock::scatter_weighted(const Eigen::VectorXd& active) {
  weighted_(active_) = stiffness_.cwiseProduct(active);
}

bool KrylovBlock::prepare(const ComplianceOperator& compliance, const Eigen::VectorXd& tangent) {
  active_.clear();
  for (int l = 0; l < tangent.size(); ++l)
    if (tangent[l] != 0.0) active_.push_back(l);
  stiffness_ = tangent(active_);
  weighted_.setZero(tangent.size());
  largest_gain_ = smallest_gain_ = 0.0;
  if (!std::isfinite(stiffness_.squaredNorm())) return false;
  const double largest = active_.empty() ? 0.0 : stiffness_.cwiseAbs().maxCoeff();
  const CoarseSize wanted = coarse_size(tangent.size(), largest);
  const auto harmonics = std::min<Eigen::Index>((compliance.points - 1) / 2, wanted.largest / 2);
  coarse_.set(compliance, static_cast<int>(harmonics), wanted);
  const Eigen::Index size = coarse_.size() + (bordered_ ? 1 : 0);
  matrix_.resize(size, size);
  coarse_.fill(tangent, matrix_);
  return true;
}

bool KrylovBlock::factorize_coarse() {
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

bool KrylovBlock::factorize(const ComplianceOperator& compliance, const Eigen::VectorXd& tangent) {
  bordered_ = false;
  return prepare(compliance, tangent) && factorize_coarse();
}

// On the active samples x = r - K D z - b y. The last row is then -(D K^T c).z + (d - c.b) y = s - c.r. With
// the preconditioner's z = v - U g - b y it becomes an equation for y and g = V D z.
bool KrylovBlock::factorize_bordered(const ComplianceOperator& compliance, const Eigen::VectorXd& tangent,
                                     const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  bordered_ = true;
  if (!prepare(compliance, tangent)) return false;
  column_ = b;
  row_ = c;
  corner_ = d - c.dot(b);
  compliance.apply_transposed(c, samples_);
  active_row_ = -gather(samples_).cwiseProduct(stiffness_);
  active_column_ = gather(b);
  const Eigen::Index size = coarse_.size();
  scatter_weighted(active_column_);
  coarse_.respond(weighted_, coefficients_);
  matrix_.col(size).head(size) = coefficients_;
  samples_.setZero();
  samples_(active_) = active_row_;
  coarse_.analyse(samples_, coefficients_);
  matrix_.row(size).head(size) = -coefficients_.transpose();
  matrix_(size, size) = corner_ - active_row_.dot(active_column_);
  return factorize_coarse();
}

// (z, y) = P^-1 (v, s).
void KrylovBlock::precondition(const Eigen::VectorXd& v, double s, Unknown& unknown) {
  scatter_weighted(v);
  coarse_.respond(weighted_, coefficients_);
  if (bordered_) {
    coefficients_.conservativeResize(coarse_.size() + 1);
    coefficients_[coarse_.size()] = s - active_row_.dot(v);
  }
  const Eigen::VectorXd solution = lu_.solve(coefficients_);
  coarse_.synthesise(solution, samples_);
  unknown.z = v - gather(samples_);
  unknown.y = bordered_ ? solution[coarse_.size()] : 0.0;
  if (bordered_) unknown.z -= unknown.y * active_column_;
}

// z + K D z + b y on the active samples.
void KrylovBlock::multiply(const ComplianceOperator& compliance, const Unknown& unknown,
                           Eigen::VectorXd& product) {
  scatter_weighted(unknown.z);
  compliance.apply(weighted_, samples_);
  product = unknown.z + gather(samples_);
  const double gain = product.norm() / unknown.z.norm();
  if (std::isfinite(gain)) {
    largest_gain_ = std::max(largest_gain_, gain);
    smallest_gain_ = smallest_gain_ > 0.0 ? std::min(smallest_gain_, gain) : gain;
  }
  if (bordered_) product += unknown.y * active_column_;
}

// P contains the last row of the bordered system exactly, so that after P^-1 (r, s) only the others have a
// residual. At a fold of a curve r - b y vanishes for the tangent, whose size is then that of the terms.
double KrylovBlock::size_of_terms(double right, const Eigen::VectorXd& z) const {
  return bordered_ ? std::max(right, z.norm()) : right;
}

KrylovBlock::Outcome KrylovBlock::solve_active(const ComplianceOperator& compliance, const Eigen::VectorXd& r,
                                               double s, double reduction, Unknown& unknown) {
  precondition(r, s, unknown);
  Unknown step;
  const auto map = [&](const Eigen::VectorXd& v, Eigen::VectorXd& image) {
    precondition(v, 0.0, step);
    multiply(compliance, step, image);
  };
  Outcome outcome;
  Eigen::VectorXd product, v;
  for (int round = 0; round <= max_refinements; ++round) {
    multiply(compliance, unknown, product);
    const Eigen::VectorXd remainder = r - product;
    const double right = bordered_ ? (r - unknown.y * active_column_).norm() : r.norm();
    const double size = size_of_terms(right, unknown.z);
    outcome.reduction = size > 0.0 ? remainder.norm() / size : 0.0;
    outcome.solved = outcome.reduction <= reduction;
    if (outcome.solved || round == max_refinements) break;
    const GmresResult found = gmres(map, remainder, 0.5 * reduction * size, max_iterations, v);
    outcome.iterations += found.iterations;
    if (found.iterations == 0 || !v.allFinite()) break;
    precondition(v, 0.0, step);
    unknown.z += step.z;
    unknown.y += step.y;
    if (!found.solved) break;
  }
  return outcome;
}

// x = r - K D z differs from z by the residual on the active samples. There x = z is used, because K D would
// magnify the residual.
void KrylovBlock::complete(const ComplianceOperator& compliance, const Eigen::VectorXd& r, double reduction,
                           const Eigen::VectorXd& z, Eigen::VectorXd& x, Outcome& outcome) {
  scatter_weighted(z);
  compliance.apply(weighted_, x);
  const double product = x.norm();
  x = r - x;
  const double size = size_of_terms(gather(r).norm(), z), residual = (gather(x) - z).norm();
  x(active_) = z;
  // The residual that GMRES updates differs from the true one when J is nearly singular.
  constexpr double rounding = 1e-13, drift = 2.0;
  outcome.solved = outcome.solved && residual <= drift * reduction * size + rounding * (product + r.norm());
  if (size > 0.0) outcome.reduction = residual / size;
}

KrylovBlock::Outcome KrylovBlock::solve(const ComplianceOperator& compliance, const Eigen::VectorXd& r,
                                        double reduction, Eigen::VectorXd& x) {
  if (active_.empty()) {
    x = r;
    return {true, 0, 0.0};
  }
  Unknown unknown;
  Outcome outcome = solve_active(compliance, gather(r), 0.0, reduction, unknown);
  complete(compliance, r, reduction, unknown.z, x, outcome);
  return outcome;
}

KrylovBlock::Outcome KrylovBlock::solve_bordered(const ComplianceOperator& compliance,
                                                 const Eigen::VectorXd& r, double s, double reduction,
                                                 Eigen::VectorXd& x, double& y) {
  Unknown unknown;
  Outcome outcome = solve_active(compliance, gather(r), s - row_.dot(r), reduction, unknown);
  y = unknown.y;
  const Eigen::VectorXd reduced = r - y * column_;
  complete(compliance, reduced, reduction, unknown.z, x, outcome);
  return outcome;
}

// Power iteration on J estimates the largest singular value, on P^-1 the smallest. Both
// start from a vector with all frequencies, because the smallest singular value may belong to a smooth
// motion.
double KrylovBlock::condition(const ComplianceOperator& compliance) {
  if (active_.empty()) return 1.0;
  Unknown unknown;
  Eigen::VectorXd product;
  const Eigen::ArrayXd samples = Eigen::ArrayXd::LinSpaced(stiffness_.size(), 0.0, stiffness_.size() - 1.0);
  const Eigen::VectorXd all_frequencies = samples.square().cos().matrix();
  unknown.z = (1.0 + all_frequencies.array()).matrix();
  multiply(compliance, unknown, product);
  if (!bordered_) {
    unknown.z = product.normalized();
    multiply(compliance, unknown, product);
    precondition(all_frequencies, 0.0, unknown);
    const Eigen::VectorXd shrunk = unknown.z.normalized();
    precondition(shrunk, 0.0, unknown);
    multiply(compliance, unknown, product);
  }
  return smallest_gain_ > 0.0 ? largest_gain_ / smallest_gain_ : 1.0;
}

}  // namespace wavebalance::solvers
