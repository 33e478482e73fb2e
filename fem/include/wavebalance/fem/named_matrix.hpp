#pragma once
#include <Eigen/SparseCore>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/fem/dof_map.hpp"

namespace wavebalance::fem {

/// A matrix or some loads as a file of another code has them.
struct NamedMatrix {
  std::string name;                    ///< in the file, such as KAAX; the title of a Harwell-Boeing file
  Eigen::SparseMatrix<double> matrix;  ///< with both triangles; of loads a column per case
  std::optional<DofMap> rows;          ///< what its rows are, ascending, where the file names nodes
  bool load = false;                   ///< whether it holds loads
};

/// A place of a matrix: "job.pch", "job.pch#KAAX" for one of several, "job.pch#PAX:2" for a column of it.
struct MatrixPlace {
  std::filesystem::path file;
  std::string name;  ///< empty: the only one
  int column = 0;    ///< from 1; 0: the only one
};

/// The place that a path names. A file whose whole name this is comes first. Throws MatrixFileError for a
/// column that is no number above 0.
MatrixPlace matrix_place(const std::filesystem::path& path);

/// All matrices and loads of a file, or those that the path names. Throws MatrixFileError.
std::vector<NamedMatrix> read_matrices(const std::filesystem::path& path);

/// The matrix that the path names. Throws MatrixFileError, also where the file holds several and the path
/// names none.
NamedMatrix read_named_matrix(const std::filesystem::path& path);

/// Likewise a load, one column. The right-hand side of a Harwell-Boeing file is one.
NamedMatrix read_load(const std::filesystem::path& path);

/// The matrix, or the loads, in the rows of a map: an entry goes where its nodes are. The others stay zero.
/// Throws MatrixFileError for an entry of a node and direction that the map does not have exactly once.
/// O(nnz log n).
Eigen::SparseMatrix<double> placed(const NamedMatrix& given, const DofMap& map);

/// Rows from 0, ascending, with 1e36 on the diagonal, by which Abaqus marks what is held. O(n).
std::vector<int> held_rows(const Eigen::SparseMatrix<double>& stiffness);

/// Matrix input and loads of Abaqus (*MATRIX OUTPUT): lines of node, degree of freedom, node, degree of
/// freedom and value, with commas or blanks, one triangle or both; below *MATRIX INPUT, TYPE=UNSYMMETRIC all
/// of a matrix; below *CLOAD lines of node, degree of freedom and value. Throws MatrixFileError.
std::vector<NamedMatrix> read_abaqus_matrix(std::istream& input, const std::string& name);

/// Matrices of a substructure of Abaqus (*SUBSTRUCTURE MATRIX OUTPUT) or CalculiX (*SUBSTRUCTURE GENERATE),
/// named by their TYPE: a user element with its nodes, their degrees of freedom and values by columns, down
/// to the diagonal unless it is UNSYMM. Throws MatrixFileError.
std::vector<NamedMatrix> read_substructure(std::istream& input, const std::string& name);

/// DMIG of Nastran in bulk data with small, large or free fields, real, in the forms 1 (square), 6
/// (symmetric), 2 and 9 (rectangular: loads). Component 0 or none belongs to a scalar point. Other entries
/// are ignored. With `wanted` the others have only names. Throws MatrixFileError.
std::vector<NamedMatrix> read_dmig(std::istream& input, const std::string& name,
                                   std::string_view wanted = {});

/// OUTPUT4 of Nastran, text or binary of either byte order and with words of 4 or 8 bytes, dense columns or
/// strings, BIGMAT or not, real, in the forms 1, 2, 6 and 9; form 2 and 9 are loads unless square. `wanted`
/// as above. Throws MatrixFileError.
std::vector<NamedMatrix> read_output4(std::istream& input, const std::string& name,
                                      std::string_view wanted = {});

/// A matrix under the name of its role.
struct CollectedMatrix {
  std::string role;  ///< mass, stiffness, damping, structural_damping, load, or else the name in its file
  std::string name;  ///< in its file, or empty
  std::filesystem::path file;
  Eigen::SparseMatrix<double> matrix;
};

/// Content of several files, in the same rows.
struct CollectedMatrices {
  std::vector<CollectedMatrix> matrices;
  std::optional<DofMap> map;  ///< all rows, where a file names them
};

/// Reads matrices, loads and at most one dof map of the formats of other codes. Its name or the name of its
/// file defines the role of a matrix. Rows follow the dof map, or else all nodes that the files name,
/// ascending; rows that the stiffness marks as held are left out. Throws MatrixFileError, also for two of
/// one role.
CollectedMatrices collect_matrices(std::span<const std::filesystem::path> files);

}  // namespace wavebalance::fem
