#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "linalg/active_inverse.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// Obstacles that are linear in contact: gap_without_force = gap - u0 (m) and flexibility (m/N, at least 0,
/// which is rigid) of each sample.
struct Obstacles {
  Eigen::VectorXd gap_without_force, flexibility;
};

/// Force samples f (N) against obstacles,
///
///   w = gap_without_force + flexibility f + K f >= 0,   f >= 0,   f w = 0   at every sample,
///
/// a linear complementarity problem. The obstacles are moved with a parameter z; the forces are then
/// piecewise linear in the path's length. The path is followed exactly from pivot to pivot, without steps of
/// a chosen size, by the parametric form of Lemke's algorithm [R. W. Cottle, J.-S. Pang, R. E. Stone, The
/// Linear Complementarity Problem, SIAM 2009, sections 4.4 and 4.5]. Each pivot takes one sample into contact
/// or out of it; z may grow again on the way. The unknowns are forces and not penetrations, so that the
/// accuracy does not degrade with stiffness.
///
/// With exact inner products and damping the path of obstacles lowered evenly cannot end on an unbounded ray,
/// because a motion without load would do work. It can if quadrature aliasing makes the contact force do
/// work.
///
/// The inverse over the samples in contact and the slope of the path are updated, and corrected every few
/// pivots: O(active^2 + C N log N + C^2 M) per pivot. Loss of accuracy is detected at the end of the path, by
/// the residual of the problem.
class ComplementarityPath {
 public:
  enum class End { reached, ray, effort_limit, lost, cancelled };
  /// Called at each pivot with z / z_start; returns false to stop.
  using Observer = std::function<bool(double z)>;

  explicit ComplementarityPath(CondensedProblem& problem);

  /// Limits the pivots of one segment, which is a call of lower() or follow().
  void set_max_segment(int pivots) { max_segment_ = pivots; }
  /// Limits the floating-point operations of all further segments together.
  void limit_operations(double most) { operations_ = std::min(operations_, most); }
  void set_observer(Observer observer) { observer_ = std::move(observer); }

  /// Lowers the obstacles, raised by z covering_vector with covering_vector > 0, from the height at which
  /// they first touch to z = 0.
  End lower(Obstacles goal, const Eigen::VectorXd& covering_vector);
  /// Moves the present obstacles to `goal`, all in proportion.
  End follow(Obstacles goal);

  /// A solution that can be restored.
  struct State {
    Obstacles obstacles;
    std::vector<int> active;  ///< samples in contact, ascending
    Eigen::VectorXd force;    ///< N
  };
  const State& state() const { return state_; }
  void restore(State state) { state_ = std::move(state); }

  const Eigen::VectorXd& force() const { return state_.force; }
  /// Condition number, 1-norm, of the block of K + flexibility over the samples in contact; 1 without any.
  double condition();
  int pivots() const { return pivots_; }  ///< pivots of all segments so far
  bool has_operations_left() const { return operations_ > 0.0; }

 private:
  double entry(int row, int column) const;
  Eigen::MatrixXd block(const std::vector<int>& samples) const;
  void invert(const std::vector<int>& samples);
  void pivot_at(int sample);
  void enter(int sample);
  void leave(int sample);
  void subtract(const Eigen::VectorXd& values, Eigen::VectorXd& all) const;
  void measure();
  void correct();
  void keep_in_contact(Eigen::VectorXd& distance) const;
  End finish();
  void set_rates(int pivoted);
  int next_pivot(double& length) const;
  End follow_segment(int sample);

  CondensedProblem& problem_;
  State state_;
  Eigen::VectorXd covering_vector_;
  ActiveInverse inverse_;  // inverse of K + flexibility over the samples in contact
  Eigen::VectorXd slope_;  // -d force / dz: the inverse times covering_vector in contact, zero elsewhere
  Eigen::VectorXd distance_, force_rate_, distance_rate_, product_;
  double z_ = 0.0, direction_ = -1.0, first_z_ = 1.0;
  int pivots_ = 0, max_segment_ = 0;
  double operations_ = std::numeric_limits<double>::infinity();  // operations left
  Observer observer_;
};

}  // namespace wavebalance::solvers
