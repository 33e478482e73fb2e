#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers::detail {

/// matrix^-1 right by LU with partial pivoting, compiled once; empty when a pivot vanishes or is not finite,
/// and for a system of no unknowns. O(n^3).
Eigen::VectorXd dense_solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

}  // namespace wavebalance::solvers::detail
