#pragma once
#include <Eigen/Core>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

/// matrix^-1 right by LU; empty when the matrix is singular or has no rows. O(n^3).
inline Eigen::VectorXd dense_solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  const Lu<double> lu(matrix);
  return lu.size() == 0 || lu.is_singular() ? Eigen::VectorXd() : lu.solve(right);
}

}  // namespace wavebalance::solvers::detail
