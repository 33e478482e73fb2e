#pragma once

#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::app {

/// Reads the matrices and loads of a scene into the rows of its stiffness. These are given by
/// structure.dof_map, or else the nodes that the file of the stiffness names, ascending, or else the rows
/// of that file. Throws StructureFault of the key whose file is wrong.
class StructureInputs {
 public:
  /// Reads the stiffness, and the map unless its path is empty.
  StructureInputs(std::string stiffness_path, const std::string& map_path);

  const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_; }
  /// Names of the rows, if a file has them.
  const std::optional<fem::DofMap>& map() const { return map_; }
  /// Another matrix of the same size.
  Eigen::SparseMatrix<double> matrix(const std::string& path, std::string_view key) const;
  /// A vector with an entry per row.
  Eigen::VectorXd load(const std::string& path, std::string_view key) const;

 private:
  Eigen::SparseMatrix<double> in_rows(const fem::NamedMatrix& given, const std::string& path,
                                      std::string_view key) const;

  std::string path_;
  std::optional<fem::DofMap> map_;
  Eigen::SparseMatrix<double> stiffness_;
};

/// The map of the rows of a scene: from the file `map_path`, or from the stiffness if that is empty; none
/// if it names no nodes. Throws fem::MatrixFileError.
std::optional<fem::DofMap> map_of_rows(const std::string& map_path, const std::string& stiffness_path);

}  // namespace wavebalance::app
