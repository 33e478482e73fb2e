#pragma once
#include <Eigen/SparseCore>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::app {

/// (A + A^T) / 2, or A itself where it is symmetric to rounding.
inline Eigen::SparseMatrix<double> symmetric_part(const Eigen::SparseMatrix<double>& matrix) {
  if (solvers::is_symmetric(matrix)) return matrix;
  return 0.5 * (matrix + Eigen::SparseMatrix<double>(matrix.transpose()));
}

}  // namespace wavebalance::app
