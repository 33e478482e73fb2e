#pragma once
#include <Eigen/Core>

#include "balance/reduction.hpp"
#include "linalg/dense.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + E R, plain or bordered, by an LU of I + R E; the reduction must outlive the solves.
class DenseBlock {
 public:
  /// False when singular to working precision. O(count^3).
  bool factorize(Reduction& reduction);
  /// x = J^-1 r.
  void solve(const Eigen::VectorXd& r, Eigen::VectorXd& x);

  /// The same for [J b; c^T d].
  bool factorize_bordered(Reduction& reduction, const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d);
  /// J x + b y = r, c.x + d y = s.
  void solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y);

  /// 1 or -1: the sign of the determinant of the matrix last factorized, that of the whole [J b; c^T d].
  int determinant_sign() const { return lu_.determinant_sign(); }
  /// Estimate of the condition number, in the 1-norm, of the matrix last factorized. O(count^2).
  double condition() const { return lu_.condition(); }

 private:
  Eigen::Index count() const { return reduction_->count(); }
  void complete(const Eigen::VectorXd& r, const Eigen::VectorXd& values, Eigen::VectorXd& x);

  Reduction* reduction_ = nullptr;
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  Eigen::VectorXd border_column_, border_row_;  // b and c of the last bordered factorization
};

}  // namespace wavebalance::solvers
