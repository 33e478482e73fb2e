#include "wavebalance/solvers/flow/settled_motion.hpp"

#include "flow/flow_start.hpp"
#include "linalg/index.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::solvers {
namespace {

// The exact motion near a state at the end of a period of the load, far from the events of its next periods.
PhaseMotion exact_from(const PhasesProblem& problem, const PeriodStart& state, int periods,
                       const ContactPhasesOptions& options) {
  constexpr double share_of_calm = 0.375;  // in the middle a contact may be about to touch
  const PhasesProblem longer = over_periods(problem, periods);
  ContactFlow flow(detail::begun_at(longer, state.begin / periods));
  flow.start(state.state, state.contacts);
  if (flow.advance_period() != FlowStatus::converged) return {};
  const auto start = detail::calmed(longer, {state.begin / periods, state.state, state.contacts},
                                    flow.events(), share_of_calm);
  return start ? flow_motion_from(longer, *start, options) : PhaseMotion();
}

// Sets the motion near the closest return of a period, if it is found.
bool set_nearest(const PhasesProblem& problem, double begin, const ContactPhasesOptions& options,
                 SettledExact& result) {
  PeriodStart nearest = result.settled.nearest;
  if (nearest.state.size() == 0) return false;
  nearest.begin = begin;
  PhaseMotion found = exact_from(problem, nearest, 1, options);
  if (!found.converged()) return false;
  result.motion = std::move(found);
  result.load_periods = 1;
  return true;
}

}  // namespace

PhasesProblem over_periods(const PhasesProblem& problem, int times) {
  PhasesProblem longer{problem.dynamics, problem.laws, {}, problem.frequency / times, problem.kept};
  longer.contact_free.setZero(problem.contact_free.rows(), (problem.contact_free.cols() - 1) * times + 1);
  for (Index n = 0; n < problem.contact_free.cols(); ++n)
    longer.contact_free.col(n * times) = problem.contact_free.col(n);
  return longer;
}

SettledExact settled_motion(const PhasesProblem& problem, TimeSteppingOptions stepping,
                            const ContactPhasesOptions& options, const std::optional<PoleStart>& start) {
  const double begin = start ? start->begin : 0.0;
  const PhasesProblem shifted = detail::begun_at(problem, begin);
  constexpr int most_periods = 8;
  SettledExact result;
  for (const double near : {1e-3, 1e-7}) {
    stepping.period_tolerance = near;
    result.settled = integrate_by_events(shifted, stepping, {}, start ? start->poles : Eigen::VectorXcd());
    const FlowMotion& settled = result.settled;
    if (settled.stepping.status == TimeSteppingStatus::cancelled) {
      result.motion = {};
      result.motion.status = PhasesStatus::cancelled;
      return result;
    }
    const int periods = settled.stepping.attractor_periods;
    if (periods < 1) break;
    if (periods > most_periods && set_nearest(problem, begin, options, result)) return result;
    PhaseMotion found = exact_from(problem, {begin, settled.state, settled.states}, periods, options);
    if (found.parts == nullptr && result.motion.parts != nullptr) break;
    result.motion = std::move(found);
    result.load_periods = periods;
    if (result.motion.status == PhasesStatus::cancelled) return result;
    if (result.motion.parts != nullptr && result.motion.count_unstable() <= 0) break;
  }
  if (!result.motion.converged()) set_nearest(problem, begin, options, result);
  return result;
}

}  // namespace wavebalance::solvers
