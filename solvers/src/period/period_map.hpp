#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// A structure at the start of a period of its load, in the coordinates of the map that made it.
struct PeriodState {
  Eigen::VectorXd motion;  ///< displacements and velocities, so scaled that the norm has a meaning
  Eigen::VectorXd force;   ///< C, N, of the contacts; empty where the map does not need them
};

/// The errors that steps may have, and the effort after which they end.
struct StepControl {
  double tolerance = 0.0;       ///< of a step, relative to the size of the state
  double max_operations = 0.0;  ///< in one period
};

/// One period of the load.
struct Period {
  enum class End { complete, effort_limit, step_failure };
  End ended = End::effort_limit;
  PeriodState state;  ///< at its end; only of a complete period
  Motion contacts;    ///< at uniform instants from its start on; only of a complete period

  bool complete() const { return ended == End::complete; }
};

/// The map of a structure in contact over a period of its load: state to state, with what the contacts do in
/// between. The two ways to integrate are ModalMap and BdfMap. For one thread at a time.
class PeriodMap {
 public:
  PeriodMap() = default;
  PeriodMap(const PeriodMap&) = delete;
  PeriodMap& operator=(const PeriodMap&) = delete;
  virtual ~PeriodMap() = default;

  /// The state of a displacement (n, m) and a velocity (n, m/s) without contact forces.
  virtual PeriodState state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const = 0;
  /// The same of `dofs` degrees of freedom, where empty vectors stand for rest.
  PeriodState state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity, int dofs) const {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(dofs);
    return state(displacement.size() > 0 ? displacement : rest, velocity.size() > 0 ? velocity : rest);
  }
  /// A state with the forces that the laws have there.
  virtual PeriodState balanced(PeriodState state) const { return state; }
  /// The norm of the whole motion of a state, to which distances are relative.
  virtual double size(const PeriodState& state) const = 0;
  /// One period from a state on.
  virtual Period advance(const PeriodState& begin, const StepControl& control) = 0;
  /// Operations of all periods so far.
  virtual double operations() const = 0;
};

}  // namespace wavebalance::solvers
