#pragma once
#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// The faces of a mesh that one element only has: its surface, to be drawn or loaded. One column a face,
/// node numbers anticlockwise seen from outside: the four corners, then for elements of 20 nodes the
/// midpoints of the edges 1-2, 2-3, 3-4, 4-1. In the order of the elements. O(elements log elements). Throws
/// std::invalid_argument as SolidMesh::validate does.
Connectivity boundary_faces(const SolidMesh& mesh);

/// The nodes of a face in their order around it, midpoints between their corners.
std::vector<int> around(const Connectivity& faces, int face);

}  // namespace wavebalance::fem
