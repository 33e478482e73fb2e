#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "linalg/dense.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// Writes K at the rows and columns `active` (ascending samples) into the leading block of `matrix`, which
/// must be at least that large. O(active^2), and the columns of K of the contacts in `active`.
void fill_active_compliance(CondensedProblem& problem, std::span<const int> active, Eigen::MatrixXd& matrix);

/// The contacts of ascending samples, `points` each, ascending.
std::vector<int> contacts_of(std::span<const int> samples, int points);
/// The same for an operator with the shifts of K whose first columns, as those of
/// CondensedProblem::columns(), are `columns`.
void fill_active_block(const CondensedProblem& problem, const Eigen::MatrixXd& columns,
                       std::span<const int> active, Eigen::MatrixXd& matrix);

/// Solves with J = I + K D, D diagonal, plain or bordered, all vectors over samples(). Exact reduction to the
/// active samples, those where D is not zero: x = r - K D x, an LU of their number and one product with K.
class ActiveBlock {
 public:
  /// Factorizes J restricted to the active samples of `tangent`, the diagonal of D. False when singular to
  /// working precision. O(active^3).
  bool factorize(CondensedProblem& problem, const Eigen::VectorXd& tangent);
  /// x = J^-1 r.
  void solve(CondensedProblem& problem, const Eigen::VectorXd& r, Eigen::VectorXd& x);

  /// The same for [J b; c^T d].
  bool factorize_bordered(CondensedProblem& problem, const Eigen::VectorXd& tangent, const Eigen::VectorXd& b,
                          const Eigen::VectorXd& c, double d);
  /// J x + b y = r, c.x + d y = s.
  void solve_bordered(CondensedProblem& problem, const Eigen::VectorXd& r, double s, Eigen::VectorXd& x,
                      double& y);
  /// 1 or -1: the sign of the determinant of the matrix last factorized, that of the whole [J b; c^T d].
  int determinant_sign() const;

  /// Estimate of the condition number, in the 1-norm, of the matrix last factorized. O(active^2).
  double condition() const;

 private:
  void collect(const Eigen::VectorXd& tangent);
  void fill(CondensedProblem& problem);
  void complete(CondensedProblem& problem, const Eigen::VectorXd& r, const Eigen::VectorXd& active_values,
                Eigen::VectorXd& x);
  Eigen::Index count() const { return static_cast<Eigen::Index>(active_.size()); }

  std::vector<int> active_;
  Eigen::VectorXd stiffness_;  // D at the active samples
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  Eigen::VectorXd weighted_, product_;
  Eigen::VectorXd border_column_, border_row_;  // b and c of the last bordered factorization
};

}  // namespace wavebalance::solvers
