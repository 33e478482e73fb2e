#include "linalg/dense_solve.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace wavebalance::solvers::detail {

Eigen::VectorXd dense_solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  if (matrix.rows() == 0) return {};
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  if (!std::isfinite(pivots.sum()) || pivots.minCoeff() <= std::numeric_limits<double>::min()) return {};
  return lu.solve(right);
}

}  // namespace wavebalance::solvers::detail
