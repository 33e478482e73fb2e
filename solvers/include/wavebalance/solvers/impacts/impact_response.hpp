#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/impacts/impact_motion.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::solvers {

/// How a motion with impacts is integrated until it repeats.
struct ImpactResponseOptions {
  int max_periods = 2000;  ///< of the load
  int longest = 16;        ///< periods of the load after which a motion may repeat
  double near = 1e-2;      ///< relative change of the state after which Newton's method is tried
  /// The deviation from the motion without contact at t = 0, one number for each of ContactDynamics::poles();
  /// empty: where it is clear of all obstacles.
  Eigen::VectorXcd start{};
  Observer observer = {};  ///< called once per period

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A forced response with impacts.
struct ImpactResponse {
  /// Over load_periods periods of the load; where a contact rests with intervals, too. Without a motion its
  /// status describes the structure: `chattering`, `lasting_contact`, `grazing`, `not_settled`,
  /// `too_many_impacts` or `cancelled`.
  ExactSolution motion;
  int load_periods = 1;          ///< after which it repeats
  Eigen::VectorXcd multipliers;  ///< empty without a motion
  int unstable = -1;             ///< multipliers outside the unit circle; -1 where not known
  int integrated = 0;            ///< periods of the load
  double distance = missing;     ///< relative change of the integrated state over the motion's period
  /// Where its impacts chatter, or its contact lasts from one on: the contact, and when its impacts end, in
  /// periods of the load after t = 0 of the integration.
  double chattering_end = missing;
  int chattering_contact = -1;

  bool moves() const { return motion.parts != nullptr; }
  bool lasts() const { return !motion.intervals.empty(); }
};

/// The motion with impacts that a structure converges to under its load, of which `problem` has one period:
/// by flights of its modes, exact between impacts, whose ends are found without missing any, until the state
/// nearly repeats after 1 to `longest` periods; then impact_motion() from the impacts of the last ones. It
/// begins where the motion without contact is farthest from all obstacles, pressed away from those that it
/// passes there. A motion that is unstable is given only where none that is stable has been found.
///
/// Where a contact without rebound is pressed after its impact, and where impacts of a contact follow each
/// other ever faster, their velocity below 1e-6 of the largest, the contact rests: attractor_motion() from
/// the same state then leads to the motion. Where it leads to none, the status is lasting_contact or
/// chattering, with the instant at which the first such impacts end, the sum of a geometric series.
///
/// Throws as impact_motion() and for options out of range. O(cells C poles) per period.
ImpactResponse impact_response(const ExactProblem& problem, const ImpactResponseOptions& options = {});

}  // namespace wavebalance::solvers
