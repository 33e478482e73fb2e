#pragma once
#include <Eigen/Core>

#include "balance/reduction.hpp"
#include "linalg/dense.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + E R, plain or bordered, by an LU of I + R E; the reduction must outlive the solves.
class DenseBlock {
 public:
  /// False when singular to working precision. O(count^3).
  bool factorize(Reduction& reduction, Border border = {});
  /// J x + b y = r, c.x + d y = s; x = J^-1 r and y = 0 without a border.
  void solve(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y);

  /// 1 or -1: the sign of the determinant of the matrix last factorized, the whole [J b; c^T d].
  int determinant_sign() const { return lu_.determinant_sign(); }
  /// Estimate of the condition number, in the 1-norm, of the matrix last factorized. O(count^2).
  double condition() const { return lu_.condition(); }

 private:
  Reduction* reduction_ = nullptr;
  Border border_;
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
};

}  // namespace wavebalance::solvers
