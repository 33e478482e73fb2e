#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "linalg/active_inverse.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// Obstacles that are linear in contact: opening = gap - u0 (m) and flexibility (m/N, at least 0, which is
/// rigid) of each sample.
struct Obstacles {
  Eigen::VectorXd opening, flexibility;
};

/// Force samples f (N) against obstacles,
///
///   w = opening + flexibility f + K f >= 0,   f >= 0,   f w = 0   at every sample,
///
/// a linear complementarity problem. The forces for obstacles that are moved with z form a piecewise linear
/// path, which is followed from corner to corner, exactly and without steps of a chosen size (the parametric
/// form of Lemke's algorithm). Each corner takes one sample into contact or out of it; where z must grow
/// again for the path to go on, it does. Forces and not penetrations are the unknowns, so that no digit is
/// lost on stiff obstacles.
///
/// With exact inner products and damping no path of obstacles lowered evenly leads to infinity: a motion
/// without load would do work. Sums over points may do some, and then it can.
///
/// The inverse over the samples that press and the slope of the path are updated, and corrected from time to
/// time: O(active^2 + C N log N + C^2 M) a corner. A path on
/// which digits were lost is told by what its end leaves of the problem.
class ComplementarityPath {
 public:
  enum class End { reached, ray, effort_limit, lost, cancelled };
  /// Told z of each corner over that at the start of the leg; false stops.
  using Observer = std::function<bool(double z)>;

  explicit ComplementarityPath(CondensedProblem& problem);

  /// Corners of one leg at most.
  void set_longest_leg(int corners) { corners_a_leg_ = corners; }
  /// Floating-point operations of all legs to come at most.
  void limit_operations(double most) { operations_ = std::min(operations_, most); }
  void set_observer(Observer observer) { observer_ = std::move(observer); }

  /// Lowers the obstacles, raised by z cover, from where they touch first to z = 0. `cover` > 0.
  End lower(Obstacles goal, const Eigen::VectorXd& cover);
  /// From the force at present obstacles to other ones, all moved in proportion.
  End follow(Obstacles goal);

  /// A solution to come back to.
  struct State {
    Obstacles obstacles;
    std::vector<int> active;  ///< samples that press, ascending
    Eigen::VectorXd force;    ///< N
  };
  const State& state() const { return state_; }
  void restore(State state) { state_ = std::move(state); }

  const Eigen::VectorXd& force() const { return state_.force; }
  /// Condition number, 1-norm, of the block of K + flexibility over the samples that press; 1 without any.
  double condition();
  int corners() const { return corners_; }  ///< of all legs
  bool may_go_on() const { return operations_ > 0.0; }

 private:
  double entry(int row, int column) const;
  Eigen::MatrixXd block(const std::vector<int>& samples) const;
  void invert(const std::vector<int>& samples);
  void turn(int sample);
  void enter(int sample);
  void leave(int sample);
  void subtract(const Eigen::VectorXd& values, Eigen::VectorXd& all) const;
  void measure();
  void correct();
  void keep_in_contact(Eigen::VectorXd& distance) const;
  End arrive();
  void set_rates(int turned);
  int next_corner(double& length) const;
  End run(int sample);

  CondensedProblem& problem_;
  State state_;
  Eigen::VectorXd cover_;
  ActiveInverse inverse_;  // of K + flexibility over the samples that press
  Eigen::VectorXd slope_;  // how force falls with z: the inverse times the cover there, elsewhere zero
  Eigen::VectorXd distance_, force_rate_, distance_rate_, product_;
  double z_ = 0.0, direction_ = -1.0, first_z_ = 1.0;
  int corners_ = 0, corners_a_leg_ = 0;
  double operations_ = std::numeric_limits<double>::infinity();  // left
  Observer observer_;
};

}  // namespace wavebalance::solvers
