#pragma once
#include <Eigen/SparseCore>

namespace wavebalance::fem {

/// Discrete linear structure M u'' + C u' + K u = f; symmetric n x n matrices, both triangles stored,
/// compressed.
struct Matrices {
  Eigen::SparseMatrix<double> mass;       ///< kg
  Eigen::SparseMatrix<double> damping;    ///< N s/m
  Eigen::SparseMatrix<double> stiffness;  ///< N/m
};

}  // namespace wavebalance::fem
