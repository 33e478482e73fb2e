#pragma once
#include <vector>

#include "wavebalance/fem/mesh.hpp"
#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// The surface of a mesh: the faces that belong to one element only. One column per face, in the order of the
/// elements, with node numbers anticlockwise as seen from outside. The four corners come first, then for
/// elements of 20 nodes the midpoints of the edges 1-2, 2-3, 3-4, 4-1. O(elements log elements). Throws
/// std::invalid_argument as SolidMesh::validate does.
Connectivity boundary_faces(const SolidMesh& mesh);

/// The visible faces of a mesh, by corner points.
struct MeshSurface {
  std::vector<int>
      triangles;              ///< three points each, of the faces that belong to one solid only and of shells
  std::vector<int> segments;  ///< two points each, of beams
};

/// O(cells log cells). Throws std::invalid_argument as Mesh::validate does, and for a cell of a type that
/// read_mesh() does not make.
MeshSurface surface_of(const Mesh& mesh);

/// The nodes of a face in their order around it, midpoints between their corners.
std::vector<int> around(const Connectivity& faces, int face);

}  // namespace wavebalance::fem
