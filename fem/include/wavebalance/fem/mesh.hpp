#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// Points and cells of any shapes, as VTK numbers and orders them.
struct Mesh {
  Eigen::Matrix3Xd points;        ///< 3 x n
  std::vector<int> cell_types;    ///< of VTK: 12 a hexahedron of 8 nodes, 25 one of 20, 3 a line, ...
  std::vector<int> cell_ends;     ///< of each cell, where its points end in `connectivity`; ascending
  std::vector<int> connectivity;  ///< points of the cells one after the other, 0..n-1

  /// Throws std::invalid_argument if a size does not fit, a point is out of range or not finite.
  void validate() const;
};

/// The same mesh.
Mesh mesh_of(const SolidMesh& mesh);

/// A mesh whose points have numbers in a file.
struct NumberedMesh {
  Mesh mesh;
  std::vector<int> nodes;  ///< number of each point, ascending
};

/// Reads the nodes and elements of an input file of CalculiX or Abaqus: *NODE, *ELEMENT with solids (C3D4, 6,
/// 8, 10, 15, 20), shells and plane elements (S, M3D, CPS, CPE, CAX of 3, 4, 6, 8 nodes), beams and trusses
/// (B31, B32, T3D2, T3D3, B21), each with any letters behind, and *INCLUDE. Springs, masses, dashpots, gaps
/// and coupling elements have no shape and are left out; so are nodes of no element. Other keywords are
/// passed by. Throws MatrixFileError, with file and line, for another element, a node that is missing or
/// there twice, and a file without elements. O(size log size).
NumberedMesh read_mesh(const std::filesystem::path& file);
/// The same from a stream, whose *INCLUDE are files relative to `folder`; errors call it `name`.
NumberedMesh read_mesh(std::istream& input, const std::string& name,
                       const std::filesystem::path& folder = {});

}  // namespace wavebalance::fem
