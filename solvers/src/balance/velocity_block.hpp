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
/// so that w = W x there decides: x = r - K w with (I + (D_u K + D_v f V K)_AA) w = W r. Where more samples
/// are active than the motions K w have coefficients, these decide in their place: with E the samples of
/// coefficients and E^+ the coefficients of motions, x = r - E a with (I + E^+ K W E) a = E^+ K W r. One LU
/// of the lesser number, and products with K.
class VelocityBlock {
 public:
  /// Keeps a reference to `map`.
  explicit VelocityBlock(VelocityMap& map) : map_(map) {}

  /// `tangent` is D_u, N/m, `damping` D_v, N s/m. False when singular to working precision. O(active^3 + C p
  /// N log N), p the shift period, or O((C M)^3 + C^2 M N log N).
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
  double operations() const { return operations_; }     ///< so far, mostly those of each LU

 private:
  Eigen::Index active() const { return static_cast<Eigen::Index>(active_.size()); }
  /// Of the LU, without a border: active samples or coefficients.
  Eigen::Index count() const { return coefficients_ > 0 ? coefficients_ : active(); }
  void collect(const CondensedProblem& problem, const Eigen::VectorXd& tangent,
               const Eigen::VectorXd& damping);
  void fill(CondensedProblem& problem);
  void fill_active(CondensedProblem& problem);
  void fill_coefficients(CondensedProblem& problem);
  bool factorize_matrix();
  Eigen::VectorXd weighted(CondensedProblem& problem, const Eigen::VectorXd& motion);
  Eigen::VectorXd response(CondensedProblem& problem, const Eigen::VectorXd& forces);
  Eigen::VectorXd right_hand_side(CondensedProblem& problem, const Eigen::VectorXd& motion);
  Eigen::VectorXd motion_of(CondensedProblem& problem, const Eigen::VectorXd& unknowns);
  Eigen::RowVectorXd transposed_motion(CondensedProblem& problem, const Eigen::VectorXd& row);

  VelocityMap& map_;
  std::vector<int> active_;
  Eigen::Index coefficients_ = 0;      // C M where they are the unknowns, else 0
  Eigen::VectorXd tangent_, damping_;  // at the active samples
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  Eigen::VectorXd border_column_, border_row_;
  double operations_ = 0.0;
};

}  // namespace wavebalance::solvers
