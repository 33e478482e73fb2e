#include "wavebalance/solvers/contact_system.hpp"

#include <cmath>
#include <limits>

#include "spans.hpp"

namespace wavebalance::solvers {
namespace {

// An LU with a vanishing or non-finite pivot says that the matrix is singular; rcond() costs more than the
// solve.
bool is_regular(const Eigen::PartialPivLU<Eigen::MatrixXd>& lu) {
  if (lu.rows() == 0) return true;
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  const double smallest = pivots.minCoeff();
  return std::isfinite(pivots.sum()) && smallest > std::numeric_limits<double>::min();
}

}  // namespace

ContactSystem::ContactSystem(CondensedProblem& problem, AnyContactLaw law)
    : problem_(&problem), law_(std::move(law)), force_(problem.points()), tangent_(problem.points()) {}

double ContactSystem::evaluate(const Eigen::VectorXd& displacement) {
  law_.evaluate(span_of(displacement), span_of(force_), span_of(tangent_));
  if (factor_ != 1.0) {
    force_ *= factor_;
    tangent_ *= factor_;
  }
  const Eigen::VectorXd& free = problem_->free_response();
  if (force_.isZero(0.0)) {
    product_.setZero(displacement.size());
  } else {
    problem_->apply(force_, product_);
  }
  residual_ = displacement - free + product_;
  const double scale = free.norm() + product_.norm();
  relative_residual_ = scale > 0.0 ? residual_.norm() / scale : residual_.norm();
  if (!std::isfinite(relative_residual_)) relative_residual_ = std::numeric_limits<double>::infinity();
  return relative_residual_;
}

void ContactSystem::collect_active() {
  active_.clear();
  for (int l = 0; l < tangent_.size(); ++l)
    if (tangent_[l] != 0.0) active_.push_back(l);
}

// I + K_AA D_A in the leading block; column m of K is column m mod r shifted by a multiple of r.
void ContactSystem::fill_active_matrix(Eigen::MatrixXd& matrix) {
  if (active_.empty()) return;
  const Eigen::MatrixXd& columns = problem_->columns();
  const int period = static_cast<int>(columns.cols());
  const int points = problem_->points();
  const auto count = static_cast<Eigen::Index>(active_.size());
  for (Eigen::Index j = 0; j < count; ++j) {
    const int m = active_[static_cast<std::size_t>(j)];
    const int shift = m - m % period;
    const double* column = columns.col(m % period).data();
    const double stiffness = tangent_[m];
    for (Eigen::Index i = 0; i < count; ++i) {
      const int row = active_[static_cast<std::size_t>(i)] - shift;
      matrix(i, j) = stiffness * column[row < 0 ? row + points : row];
    }
    matrix(j, j) += 1.0;
  }
}

// x = r - K D x, the active values of x known.
void ContactSystem::complete(const Eigen::VectorXd& r, const Eigen::VectorXd& active_values,
                             Eigen::VectorXd& x) {
  if (active_.empty()) {
    x = r;
    return;
  }
  Eigen::VectorXd weighted = Eigen::VectorXd::Zero(r.size());
  for (std::size_t i = 0; i < active_.size(); ++i)
    weighted[active_[i]] = tangent_[active_[i]] * active_values[static_cast<Eigen::Index>(i)];
  problem_->apply(weighted, x);
  x = r - x;
}

bool ContactSystem::factorize() {
  collect_active();
  const auto count = static_cast<Eigen::Index>(active_.size());
  matrix_.resize(count, count);
  fill_active_matrix(matrix_);
  if (count > 0) lu_.compute(matrix_);
  return count == 0 || is_regular(lu_);
}

void ContactSystem::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(active_.size()));
  for (std::size_t i = 0; i < active_.size(); ++i) values[static_cast<Eigen::Index>(i)] = r[active_[i]];
  if (!active_.empty()) values = lu_.solve(values).eval();
  complete(r, values, x);
}

bool ContactSystem::factorize_bordered(const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  collect_active();
  border_column_ = b;
  border_row_ = c;
  border_corner_ = d;
  const auto count = static_cast<Eigen::Index>(active_.size());
  matrix_.resize(count + 1, count + 1);
  fill_active_matrix(matrix_);
  Eigen::VectorXd transposed(b.size());
  if (count > 0) problem_->apply_transposed(c, transposed);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int m = active_[static_cast<std::size_t>(i)];
    matrix_(i, count) = b[m];
    matrix_(count, i) = -transposed[m] * tangent_[m];
  }
  matrix_(count, count) = d - c.dot(b);
  lu_.compute(matrix_);
  return is_regular(lu_);
}

void ContactSystem::solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y) {
  const auto count = static_cast<Eigen::Index>(active_.size());
  Eigen::VectorXd values(count + 1);
  for (Eigen::Index i = 0; i < count; ++i) values[i] = r[active_[static_cast<std::size_t>(i)]];
  values[count] = s - border_row_.dot(r);
  values = lu_.solve(values).eval();
  y = values[count];
  const Eigen::VectorXd reduced = r - border_column_ * y;
  complete(reduced, values.head(count), x);
}

}  // namespace wavebalance::solvers
