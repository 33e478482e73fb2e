#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem {

/// A motion of a node of a mesh: displacement along x, y, z (1, 2, 3), or rotation about it (4, 5, 6), or
/// the one of a scalar point of Nastran (7). Internal nodes of Abaqus have negative numbers. Where several
/// rows have the same node and direction, as for shells and beams that a code has expanded to solids, each
/// is a copy, counted from 1 in the order of the rows.
struct NodeDof {
  int node = 0;
  int direction = 0;
  int copy = 1;

  auto operator<=>(const NodeDof&) const = default;
};

/// The direction by its name, in letters of either case: x, y, z, ux, uy, uz, rx, ry, rz, rotx, roty, rotz,
/// scalar, or a number in 1..6. 0 if it is none of these.
int direction_of(std::string_view name);
/// "node 1042 z", without its copy.
std::string to_string(const NodeDof& dof);
/// "x", "y", "z", "rx", "ry", "rz" or "scalar" for a direction in 1..7.
std::string_view direction_name(int direction);

/// Which row of the matrices is which motion of which node. Immutable.
class DofMap {
 public:
  /// Row i is dofs[i]; the copies of those that are there several times are counted here. Throws
  /// std::invalid_argument for a direction out of 1..7. O(rows log rows).
  explicit DofMap(std::vector<NodeDof> dofs);

  int rows() const { return static_cast<int>(dofs_.size()); }
  /// The row, from 0, or -1 if the map has no such motion. O(log rows).
  int row(const NodeDof& dof) const;
  /// How many rows have this node and direction. O(log rows).
  int copies(const NodeDof& dof) const;
  /// The motion of a row from 0.
  const NodeDof& dof(int row) const { return dofs_.at(static_cast<std::size_t>(row)); }
  /// The directions that a node has in the map, ascending; none if it is no node of the map. O(log rows).
  std::vector<int> directions(int node) const;
  /// "node 1042 z" for a row from 0, or "node 1042 z #2" of the second row of this name.
  std::string name(int row) const;

 private:
  std::vector<NodeDof> dofs_;
  std::vector<std::pair<NodeDof, int>> sorted_;
};

/// Reads a dof map: the .dof file of CalculiX, a line "node.direction" per row of the matrices, or a table of
/// columns node and direction, separated by commas, semicolons or blanks. Its first line may name the
/// columns, with a third one, "row" (from 1), where the lines are not in the order of the rows; Ansys (HBMAT)
/// calls it "Matrix Eqn". Lines that open with # are comments. Throws MatrixFileError with file and line.
DofMap read_dof_map(const std::filesystem::path& file);
/// The same from a stream; errors call it `name`.
DofMap read_dof_map(std::istream& input, const std::string& name);

/// The columns node and direction of a map, a line per row, which read_dof_map() reads.
std::string dof_map_text(const DofMap& map);

}  // namespace wavebalance::fem
