#pragma once
#include <Eigen/Core>

#include "linalg/dense.hpp"

namespace wavebalance::solvers {

/// Solves [jacobian; row last] (change, parameter_change) = (right, last_right) for a jacobian of n x (n +
/// 1). False where the matrix is singular. O(n^3).
inline bool solve_bordered_dense(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& row, double last,
                                 const Eigen::VectorXd& right, double last_right, Eigen::VectorXd& change,
                                 double& parameter_change) {
  Eigen::MatrixXd matrix(row.size() + 1, row.size() + 1);
  matrix << jacobian, row.transpose(), last;
  const detail::Lu<double> lu(matrix);
  if (lu.is_singular(0.0)) return false;
  Eigen::VectorXd solution(row.size() + 1);
  solution << right, last_right;
  solution = lu.solve(solution);
  change = solution.head(row.size());
  parameter_change = solution[row.size()];
  return true;
}

}  // namespace wavebalance::solvers
