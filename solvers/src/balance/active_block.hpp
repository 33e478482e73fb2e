#pragma once
#include <Eigen/Core>

#include "balance/active_slopes.hpp"
#include "linalg/dense.hpp"
#include "wavebalance/solvers/balance/contact_operator.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + K D, plain or bordered, all vectors over samples(), D = S B (ActiveSlopes). Exact
/// reduction to the active samples: x = r - K S z with (I + B K S) z = B r, an LU of their number and one
/// product with K.
class ActiveBlock {
 public:
  /// Factorizes for `slopes`, which must outlive the solves. False when singular to working precision.
  /// O(active^3).
  bool factorize(ContactOperator& contact, ActiveSlopes& slopes);
  /// x = J^-1 r.
  void solve(ContactOperator& contact, const Eigen::VectorXd& r, Eigen::VectorXd& x);

  /// The same for [J b; c^T d].
  bool factorize_bordered(ContactOperator& contact, ActiveSlopes& slopes, const Eigen::VectorXd& b,
                          const Eigen::VectorXd& c, double d);
  /// J x + b y = r, c.x + d y = s.
  void solve_bordered(ContactOperator& contact, const Eigen::VectorXd& r, double s, Eigen::VectorXd& x,
                      double& y);
  /// 1 or -1: the sign of the determinant of the matrix last factorized, that of the whole [J b; c^T d].
  int determinant_sign() const;

  /// Estimate of the condition number, in the 1-norm, of the matrix last factorized. O(active^2).
  double condition() const;

 private:
  void fill(ContactOperator& contact);
  void complete(ContactOperator& contact, const Eigen::VectorXd& r, const Eigen::VectorXd& active_values,
                Eigen::VectorXd& x);
  Eigen::Index count() const { return slopes_->count(); }

  ActiveSlopes* slopes_ = nullptr;
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  Eigen::VectorXd weighted_, product_;
  Eigen::VectorXd border_column_, border_row_;  // b and c of the last bordered factorization
};

}  // namespace wavebalance::solvers
