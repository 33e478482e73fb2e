#include <algorithm>
#include <limits>
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"

namespace wavebalance::solvers::detail {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, double dependent) {
  const lapack_int rows = lapack_size(matrix.rows()), columns = lapack_size(matrix.cols());
  Eigen::MatrixXd factors = matrix;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(std::max(rows, columns));
  if (matrix.size() == 0) return solution.head(columns);
  solution.head(rows) = right;
  std::vector<lapack_int> pivots(static_cast<std::size_t>(columns), 0);
  dependent = std::max(dependent, std::numeric_limits<double>::epsilon() * std::min(rows, columns));
  lapack_int rank = 0;
  LAPACKE_dgelsy(LAPACK_COL_MAJOR, rows, columns, 1, factors.data(), rows, solution.data(),
                 lapack_size(solution.size()), pivots.data(), dependent, &rank);
  return solution.head(columns);
}

}  // namespace wavebalance::solvers::detail
