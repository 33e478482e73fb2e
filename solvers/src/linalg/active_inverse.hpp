#pragma once
#include <Eigen/Core>
#include <vector>

namespace wavebalance::solvers {

/// Inverse of the block of a matrix over a set of its rows and columns, the members, which enter and leave
/// one by one. Vectors are indexed by slot. Slots of removed members stay empty: inputs must be zero there,
/// outputs are undefined.
///
/// Each change is a term of rank one. Terms are collected and added to the inverse in one product, because
/// passes over the inverse in memory take most of the time. In the costs below n is the number of slots and k
/// that of the terms collected.
class ActiveInverse {
 public:
  /// For members out of 0..total-1.
  explicit ActiveInverse(int total);

  /// Starts anew: `inverse` over `members` in their order. O(n^2).
  void assign(const std::vector<int>& members, const Eigen::MatrixXd& inverse);

  bool contains(int member) const { return slots_[static_cast<std::size_t>(member)] >= 0; }
  /// The member in each slot, -1 in an empty one.
  const std::vector<int>& members() const { return members_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(members_.size()); }
  /// Members without gaps, ascending.
  std::vector<int> ascending() const;
  int updates() const { return updates_; }  ///< since assign()

  /// Values at the members out of those of all, zero in empty slots.
  Eigen::VectorXd gather(const Eigen::VectorXd& all) const;
  /// inverse * right, and with its transpose; n x any. O(n^2) per column.
  Eigen::MatrixXd times(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd transposed_times(const Eigen::MatrixXd& right) const;

  /// Adds the terms gathered once they are as many as are kept, and closes gaps: slots change here alone and
  /// in matrix(). To be called before each change. O(n^2 k), once in k changes.
  void apply_pending_updates();
  /// Takes in `member` by the Schur complement `pivot` of its diagonal entry, right = inverse * column and
  /// left = inverse^T row of its entries. O(n).
  void enter(int member, const Eigen::VectorXd& right, const Eigen::VectorXd& left, double pivot);
  /// Takes out `member`. Returns its column of the inverse over its diagonal entry. O(n k).
  Eigen::VectorXd leave(int member);

  /// The inverse over members(), none of whose slots is empty after it.
  Eigen::Ref<const Eigen::MatrixXd> matrix();

 private:
  void make_room();
  void compact();
  void close_gaps();

  std::vector<int> members_, slots_;  // the slot of each member of all, or -1
  Eigen::MatrixXd base_;              // the leading block, in a larger array
  Eigen::MatrixXd left_, right_;      // terms gathered: inverse = base + right left^T
  Eigen::Index terms_ = 0;
  int updates_ = 0;
};

}  // namespace wavebalance::solvers
