#include <Eigen/QR>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.completeOrthogonalDecomposition().solve(right);
}

}  // namespace wavebalance::solvers::detail
