#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/flow/contact_flow.hpp"
#include "wavebalance/solvers/period/time_stepping.hpp"

namespace wavebalance::solvers {

/// A motion that was integrated from event to event until it repeated.
struct FlowMotion {
  TimeSteppingResult stepping;  ///< the last period, and how it was reached
  FlowStatus ended = FlowStatus::converged;
  ExactSolution motion;           ///< the last period; without parts where it was not completed
  std::vector<FlowEvent> events;  ///< of the last period, in s from its beginning
  std::vector<Impact> impacts;    ///< among these, in periods
  std::vector<ContactMachine> machines;
  std::vector<std::vector<int>> sampled_states;  ///< of the machines at the samples of the last period
  std::vector<FrictionCycle> cycles;             ///< of the machines in the last period
  std::vector<int> states;                       ///< of the machines at the end
  Eigen::VectorXd state;                         ///< ContactFlow::state() there
  PeriodStart nearest;      ///< of all periods the beginning of the one that came back nearest
  double operations = 0.0;  ///< estimated, of all periods integrated
  int rests = 0;            ///< impacts of the last period without rebound, FlowOptions::rest_velocity
  /// Relative distance of the state from that one period later, after Newton's method on the map of the
  /// period; missing where that was not tried or found no motion.
  double closed = missing;
  /// Floquet multipliers by falling modulus; empty unless the motion is closed.
  Eigen::VectorXcd multipliers;
};

/// Integrates from contacts at rest, and the structure elsewhere in its motion without contact, or from
/// states of the poles, until two successive periods of the displacements differ by less than
/// period_tolerance, then closes the period by Newton's method: the motion is then exact to the tolerance of
/// the panels, and its multipliers are known. A slider that does not move keeps its position, which has a
/// multiplier of 1 that is left out. Throws as ContactFlow does, and for options out of range.
FlowMotion integrate_by_events(const ExactProblem& problem, const TimeSteppingOptions& options,
                               const FlowOptions& flow = {}, const Eigen::VectorXcd& poles = {});
/// The same of a structure under the load of a problem, at its frequency.
FlowMotion integrate_by_events(const CondensedProblem& problem, const ContactDynamics& dynamics,
                               const ContactLaws& laws, const TimeSteppingOptions& options,
                               const FlowOptions& flow = {});

}  // namespace wavebalance::solvers
