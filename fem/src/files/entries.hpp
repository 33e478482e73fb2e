#pragma once

#include <functional>
#include <unordered_map>

#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::fem::detail {

using MatrixEntries = std::vector<Eigen::Triplet<double, int>>;

/// On the diagonal, what Abaqus writes for a row that is held; no size of stiffness.
constexpr double held_diagonal = 1e36;

/// Name of the entry of a row and a column (from 0) in errors.
using EntryName = std::function<std::string(int row, int column)>;
/// "(3, 1)"
std::string place_text(int row, int column);

/// The compressed matrix of entries, each given once. A symmetric matrix has one of (i, j) and (j, i) in
/// `entries`, or everywhere both, and both in the result. Throws MatrixFileError "<name>: the entry (i, j) is
/// given twice, as a and b", or of two triangles that differ "<name>: the entry (i, j) is a and (j, i) is b".
Eigen::SparseMatrix<double> matrix_of(MatrixEntries entries, int rows, int columns, bool symmetric,
                                      const std::string& name, const EntryName& entry_name = place_text);

/// Whether the row of the last entry has none on the diagonal, as all other rows of entries have: programs
/// end each row of a symmetric matrix with it, so that the file was cut off.
bool ends_within_a_row(const MatrixEntries& entries);
constexpr const char* cut_row =
    "the last row has no entry on the diagonal, as all rows before it have; the file is cut off";

/// Entries of a matrix whose rows, and columns if it is square, are named by nodes.
class LabelledEntries {
 public:
  /// The place of a label, which is added if it is new.
  int place(const NodeDof& dof);
  /// Zeros are left out.
  void add(int row, int column, double value);
  bool empty() const { return dofs_.empty(); }
  bool ends_within_a_row() const { return !entries_.empty() && detail::ends_within_a_row(entries_); }

  /// The matrix with its rows by ascending labels; both triangles if it is symmetric. Throws MatrixFileError
  /// as matrix_of() does, with the names of nodes.
  NamedMatrix square(std::string name, bool symmetric, const std::string& file) const;
  /// The same of loads, whose columns have numbers.
  NamedMatrix loads(std::string name, int columns, const std::string& file) const;

 private:
  struct Order {
    std::vector<NodeDof> dofs;  ///< ascending
    std::vector<int> rows;      ///< of each place
  };
  Order ascending() const;

  std::vector<NodeDof> dofs_;
  std::unordered_map<std::int64_t, int> places_;
  MatrixEntries entries_;
};

}  // namespace wavebalance::fem::detail
