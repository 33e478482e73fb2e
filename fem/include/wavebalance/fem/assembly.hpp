#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <span>
#include <vector>

namespace wavebalance::fem {

/// One column per element: the numbers of its unknowns or nodes.
using Connectivity = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic>;

/// Numbering of the dofs of a structure that are free to move: dof = 0..dofs()-1 counts all, unknown =
/// 0..count()-1 those that are not held.
class FreeDofs {
 public:
  /// No dof at all.
  FreeDofs() = default;
  /// Holds the dofs listed (any order, repeats allowed) at zero. Throws std::invalid_argument if dofs is
  /// negative or an entry of held is not in 0..dofs-1. O(dofs).
  FreeDofs(int dofs, std::span<const int> held);

  int dofs() const { return static_cast<int>(unknowns_.size()); }
  int count() const { return static_cast<int>(free_.size()); }
  /// The unknown of a dof, -1 for one that is held. Throws std::out_of_range as std::vector::at does.
  int unknown(int dof) const { return unknowns_.at(static_cast<std::size_t>(dof)); }
  /// The dof of each unknown, ascending.
  const std::vector<int>& free() const { return free_; }
  /// The dofs() values that belong to count() unknowns, zero where held. Throws std::invalid_argument for
  /// another size.
  Eigen::VectorXd expand(const Eigen::VectorXd& unknowns) const;
  /// Every dof replaced by its unknown, -1 for those held. Throws std::out_of_range for a number that is no
  /// dof.
  Connectivity unknowns(const Connectivity& dofs) const;

 private:
  std::vector<int> unknowns_;
  std::vector<int> free_;
};

/// Sums element matrices into a compressed sparse matrix in two passes: the constructor finds the pattern,
/// and each matrix is added into it in place. One plan serves any number of matrices; it is not changed by
/// assembling, so threads may share it.
class Assembly {
 public:
  /// connectivity: k x elements, entries in -1..unknowns-1; -1 leaves that row and column out. Throws
  /// std::invalid_argument for another entry. O(elements k^2), memory of one pattern.
  Assembly(int unknowns, Connectivity connectivity);

  /// The sum of the k x k matrices element_matrix(element), element = 0..elements-1, in this order. All
  /// entries of the pattern are stored, zeros too. Throws std::invalid_argument if an element matrix has
  /// another size.
  Eigen::SparseMatrix<double> matrix(const std::function<Eigen::MatrixXd(int)>& element_matrix) const;
  /// The same for k-vectors.
  Eigen::VectorXd vector(const std::function<Eigen::VectorXd(int)>& element_vector) const;

 private:
  void find_pattern();

  Connectivity connectivity_;
  Eigen::SparseMatrix<double> pattern_;
};

}  // namespace wavebalance::fem
