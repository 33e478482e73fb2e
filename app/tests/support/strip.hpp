#pragma once
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/matrix_market.hpp"

/// The steel strip of scenes/matrices: 0.2 m x 0.02 m x 0.004 m along x, clamped at x = 0, in six 8-node
/// hexahedra.
inline wavebalance::fem::SolidModel strip() {
  namespace fem = wavebalance::fem;
  const auto block = fem::structured_mesh(fem::SolidElement::hexahedron8, {6, 1, 1},
                                          [](const Eigen::Vector3d& at) -> Eigen::Vector3d {
                                            return {0.2 * at[0], 0.02 * at[1], 0.004 * at[2]};
                                          });
  const auto clamped = block.nodes_where([](const Eigen::Vector3d& at) { return at[0] == 0.0; });
  return fem::hold_nodes(block.mesh, {.youngs_modulus = 210e9, .poissons_ratio = 0.3, .density = 7800.0},
                         clamped);
}

/// Its matrices, symmetric to the last bit, as they are written to the files.
inline wavebalance::fem::Matrices strip_matrices() {
  auto matrices = wavebalance::fem::solid_matrices(strip());
  for (auto* matrix : {&matrices.mass, &matrices.stiffness})
    *matrix = Eigen::SparseMatrix<double>(0.5 * (*matrix + Eigen::SparseMatrix<double>(matrix->transpose())));
  return matrices;
}
