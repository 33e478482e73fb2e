#pragma once
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "matrix_entries.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::fem::detail {

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
