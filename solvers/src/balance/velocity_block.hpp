#pragma once
#include <Eigen/Core>
#include <vector>

#include "balance/velocity_map.hpp"
#include "linalg/dense.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + K W, W = D_u + D_v f V, plain or bordered, all vectors over samples(): forces that
/// depend on displacements and velocities, with the diagonals D_u and D_v of their slopes and the map V to
/// velocities (VelocityMap). W has rows at the active samples alone, where one of its diagonals is not zero,
/// so that w = W x there decides: x = r - K w with (I + (D_u K + D_v f V K)_AA) w = W r. One LU of the number
/// of active samples, and products with K.
class VelocityBlock {
 public:
  /// Keeps a reference to `map`.
  explicit VelocityBlock(VelocityMap& map) : map_(map) {}

  /// `tangent` is D_u, N/m, `damping` D_v, N s/m. False when singular to working precision. O(active^3 + C p
  /// N log N), p the shift period.
  bool factorize(CondensedProblem& problem, const Eigen::VectorXd& tangent, const Eigen::VectorXd& damping);
  /// x = J^-1 r.
  void solve(CondensedProblem& problem, const Eigen::VectorXd& r, Eigen::VectorXd& x);

  /// The same for [J b; c^T d].
  bool factorize_bordered(CondensedProblem& problem, const Eigen::VectorXd& tangent,
                          const Eigen::VectorXd& damping, const Eigen::VectorXd& b, const Eigen::VectorXd& c,
                          double d);
  /// J x + b y = r, c.x + d y = s.
  void solve_bordered(CondensedProblem& problem, const Eigen::VectorXd& r, double s, Eigen::VectorXd& x,
                      double& y);

  /// 1 or -1: the sign of the determinant of the matrix last factorized, that of the whole [J b; c^T d].
  int determinant_sign() const { return lu_.determinant_sign(); }
  double condition() const { return lu_.condition(); }  ///< in the 1-norm, estimated
  double operations() const { return operations_; }     ///< so far, 2/3 active^3 per LU

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(active_.size()); }
  void collect(const Eigen::VectorXd& tangent, const Eigen::VectorXd& damping);
  void fill(CondensedProblem& problem);
  bool factorize_matrix();
  Eigen::VectorXd weighted(CondensedProblem& problem, const Eigen::VectorXd& motion);
  void complete(CondensedProblem& problem, const Eigen::VectorXd& r, const Eigen::VectorXd& forces,
                Eigen::VectorXd& x);

  VelocityMap& map_;
  std::vector<int> active_;
  Eigen::VectorXd tangent_, damping_;  // at the active samples
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  Eigen::VectorXd border_column_, border_row_;
  double operations_ = 0.0;
};

}  // namespace wavebalance::solvers
