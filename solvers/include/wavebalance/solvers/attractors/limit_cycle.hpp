#pragma once
#include <string_view>

#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers {

enum class LimitCycleStatus {
  converged,
  at_rest,     ///< every start came to rest, which is no proof that there is no limit cycle
  grows,       ///< motions from some starts grow without end, and none led to a limit cycle
  no_return,   ///< motions did not come back to a state within the periods integrated
  not_solved,  ///< the motion repeats, and its equations were not solved to the tolerance
  cancelled    ///< the observer returned false
};

std::string_view to_string(LimitCycleStatus status);

/// A limit cycle nearby, as of other values of a parameter.
struct CycleNearby {
  Eigen::MatrixXd displacement, force;  ///< of the contacts at uniform times of its period, m and N
  double frequency = 0.0;               ///< Hz; 0: none is known
};

struct LimitCycleOptions {
  CycleNearby near = {};  ///< the first start, before contacts at rest
  /// Random states that are integrated one after the other until one leads to a limit cycle, in addition to
  /// contacts at rest and contacts that move with their surfaces.
  int random_starts = 8;
  unsigned seed = 1;
  int max_periods = 5000;  ///< of the slowest mode, from each start
  CollocationOptions motion = {};

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A periodic motion that a structure without periodic load keeps up by itself.
struct LimitCycle {
  LimitCycleStatus status = LimitCycleStatus::at_rest;
  /// Its frequency() is the frequency of the cycle. Time 0 is the first instant at which a contact begins
  /// to stick, or else its first event. Multipliers exclude the trivial one of a perturbation along the
  /// motion.
  ExactSolution motion;
  int starts = 0;          ///< that were tried
  int came_to_rest = 0;    ///< of these
  int grew = 0, lost = 0;  ///< without end; neither of these, nor to a limit cycle
  double periods = 0.0;    ///< of the slowest mode, that were integrated
};

/// The limit cycle that a structure under static loads converges to, by friction against surfaces that move,
/// by damping that is negative somewhere, or by matrices without symmetry: ContactFlow from each start until
/// the contacts come back to a state, and from there Newton's method for state and period at once,
/// autonomous_motion_from(). An unstable one is given where the motion leads to no other. Throws
/// std::invalid_argument for a periodic load, for options out of range, and as ContactFlow does.
LimitCycle limit_cycle(const ExactProblem& problem, const LimitCycleOptions& options = {});

}  // namespace wavebalance::solvers
