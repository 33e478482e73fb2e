#pragma once

#include "matrices/structure_files.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::app {

/// Unknowns of which a reduction keeps one coordinate, their sum with these weights. The first has the weight
/// 1.
struct BoundaryCoordinate {
  std::vector<int> unknowns;
  std::vector<double> weights;
};

/// Coordinates that a reduction keeps in addition to its modes: the unknowns that contacts touch, then
/// those loaded. Rows of one name, as of a node of an expanded beam, are one coordinate if all contacts and
/// loads have them in the same proportions.
std::vector<BoundaryCoordinate> boundary_coordinates(const Scene& scene, const StructureFiles& files);

/// The unknowns that the coordinates replace, the first one of each.
std::vector<int> unknowns_of(const std::vector<BoundaryCoordinate>& boundary);

/// B, n x n, of u = B w with the coordinates in those places of w; 0 x 0 where each coordinate is an unknown.
Eigen::SparseMatrix<double> merging(const std::vector<BoundaryCoordinate>& boundary, Eigen::Index size);

/// B^T A B of M, C and K.
fem::Matrices merged(const fem::Matrices& matrices, const Eigen::SparseMatrix<double>& merging);

/// S B with exact zeros instead of rounding errors.
solvers::ContactDirections merged(const solvers::ContactDirections& directions,
                                  const Eigen::SparseMatrix<double>& merging);

}  // namespace wavebalance::app
