#pragma once
#include <Eigen/SparseCore>
#include <optional>

#include "wavebalance/fem/dof_map.hpp"

namespace wavebalance::fem {

/// The least number of nodes that are internal to elements: their rows are amplitudes of incompatible modes
/// and no displacements, as CalculiX appends them with numbers above all others for C3D8I and what it makes
/// of it, B31 and S4. Nothing where there are none.
///
/// A translation of all nodes strains nothing, K r = 0 except near supports. If internal nodes move along,
/// every element is strained. So nodes are removed from the translation from the highest number on: nodes
/// without which the strain falls below a tenth are internal. K has a row for each of the map. O(entries).
std::optional<int> first_internal_node(const Eigen::SparseMatrix<double>& stiffness, const DofMap& map);

}  // namespace wavebalance::fem
