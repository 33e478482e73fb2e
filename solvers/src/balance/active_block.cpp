#include "balance/active_block.hpp"

namespace wavebalance::solvers {

std::vector<int> contacts_of(std::span<const int> samples, int points) {
  std::vector<int> contacts;
  for (const int sample : samples)
    if (contacts.empty() || contacts.back() != sample / points) contacts.push_back(sample / points);
  return contacts;
}

void fill_active_compliance(CondensedProblem& problem, std::span<const int> active, Eigen::MatrixXd& matrix) {
  if (active.empty()) return;
  fill_active_block(problem, problem.columns(contacts_of(active, problem.points())), active, matrix);
}

// K is invariant under shifts by the shift period. The column of a point is that of the point modulo the
// period, with the samples of each contact shifted by the remaining points.
void fill_active_block(const CondensedProblem& problem, const Eigen::MatrixXd& columns,
                       std::span<const int> active, Eigen::MatrixXd& matrix) {
  const int points = problem.points(), period = problem.pair().shift_period();
  std::vector<int> row_point(active.size()), row_start(active.size());
  for (std::size_t i = 0; i < active.size(); ++i) {
    row_point[i] = active[i] % points;
    row_start[i] = active[i] - row_point[i];
  }
  for (std::size_t j = 0; j < active.size(); ++j) {
    const int remainder = row_point[j] % period, shift = row_point[j] - remainder;
    const double* column = columns.col(row_start[j] / points * period + remainder).data();
    double* out = matrix.col(static_cast<Eigen::Index>(j)).data();
    for (std::size_t i = 0; i < active.size(); ++i) {
      const int point = row_point[i] - shift;
      out[i] = column[row_start[i] + (point < 0 ? point + points : point)];
    }
  }
}

void ActiveBlock::collect(const Eigen::VectorXd& tangent) {
  active_.clear();
  for (int l = 0; l < tangent.size(); ++l)
    if (tangent[l] != 0.0) active_.push_back(l);
  stiffness_ = tangent(active_);
}

// I + K_AA D_A in the leading block.
void ActiveBlock::fill(CondensedProblem& problem) {
  fill_active_compliance(problem, active_, matrix_);
  auto block = matrix_.topLeftCorner(count(), count());
  block *= stiffness_.asDiagonal();
  block.diagonal().array() += 1.0;
}

// x = r - K D x, from the known active values of x.
void ActiveBlock::complete(CondensedProblem& problem, const Eigen::VectorXd& r,
                           const Eigen::VectorXd& active_values, Eigen::VectorXd& x) {
  x = r;
  if (active_.empty()) return;
  weighted_.setZero(r.size());
  weighted_(active_) = stiffness_.cwiseProduct(active_values);
  problem.apply(weighted_, product_);
  x -= product_;
}

bool ActiveBlock::factorize(CondensedProblem& problem, const Eigen::VectorXd& tangent) {
  collect(tangent);
  matrix_.resize(count(), count());
  fill(problem);
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void ActiveBlock::solve(CondensedProblem& problem, const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  Eigen::VectorXd values = r(active_);
  if (!active_.empty()) values = lu_.solve(values);
  complete(problem, r, values, x);
}

bool ActiveBlock::factorize_bordered(CondensedProblem& problem, const Eigen::VectorXd& tangent,
                                     const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  collect(tangent);
  border_column_ = b;
  border_row_ = c;
  matrix_.resize(count() + 1, count() + 1);
  fill(problem);
  if (count() > 0) {
    problem.apply_transposed(c, product_);
    matrix_.col(count()).head(count()) = b(active_);
    matrix_.row(count()).head(count()) = -product_(active_).cwiseProduct(stiffness_).transpose();
  }
  matrix_(count(), count()) = d - c.dot(b);
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void ActiveBlock::solve_bordered(CondensedProblem& problem, const Eigen::VectorXd& r, double s,
                                 Eigen::VectorXd& x, double& y) {
  Eigen::VectorXd values(count() + 1);
  values.head(count()) = r(active_);
  values[count()] = s - border_row_.dot(r);
  values = lu_.solve(values);
  y = values[count()];
  complete(problem, r - border_column_ * y, values.head(count()), x);
}

double ActiveBlock::condition() const { return lu_.condition(); }

// Eliminating the samples without stiffness, on whose columns J is the identity, does not change the
// determinant.
int ActiveBlock::determinant_sign() const { return lu_.determinant_sign(); }

}  // namespace wavebalance::solvers
