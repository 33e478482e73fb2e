#pragma once
#include <Eigen/SparseCore>

#include "wavebalance/fem/mesh.hpp"

namespace wavebalance::app {

/// The mesh of a structure of matrices and how it moves.
struct MovedMesh {
  fem::Mesh mesh;
  /// 3 nodes x unknowns: displacements of the nodes, x, y and z of each, from displacements of the
  /// structure.
  Eigen::SparseMatrix<double> displacements;
};

}  // namespace wavebalance::app
