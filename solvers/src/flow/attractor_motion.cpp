#include "wavebalance/solvers/flow/attractor_motion.hpp"

#include "flow/flow_start.hpp"
#include "linalg/index.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::solvers {
namespace {

// The exact motion near a state at the end of a period of the load, far from the events of its next periods.
ExactSolution exact_from(const ExactProblem& problem, const PeriodStart& state, int periods,
                         const CollocationOptions& options) {
  constexpr double share_of_calm = 0.375;  // in the middle a contact may be about to touch
  const ExactProblem longer = over_periods(problem, periods);
  ContactFlow flow(detail::begun_at(longer, state.begin / periods));
  flow.start(state.state, state.contacts);
  if (flow.advance_period() != FlowStatus::converged) return {};
  const auto start = detail::calmed(longer, {state.begin / periods, state.state, state.contacts},
                                    flow.events(), share_of_calm);
  return start ? flow_motion_from(longer, *start, options) : ExactSolution();
}

// Sets the motion near the closest return of a period, if it is found.
bool set_nearest(const ExactProblem& problem, double begin, const CollocationOptions& options,
                 ExactAttractor& result) {
  PeriodStart nearest = result.settled.nearest;
  if (nearest.state.size() == 0) return false;
  nearest.begin = begin;
  ExactSolution found = exact_from(problem, nearest, 1, options);
  if (!found.converged()) return false;
  result.motion = std::move(found);
  result.load_periods = 1;
  return true;
}

}  // namespace

ExactProblem over_periods(const ExactProblem& problem, int times) {
  ExactProblem longer{problem.dynamics, problem.laws, {}, problem.frequency / times, problem.kept};
  longer.linear_motion.setZero(problem.linear_motion.rows(), (problem.linear_motion.cols() - 1) * times + 1);
  for (Index n = 0; n < problem.linear_motion.cols(); ++n)
    longer.linear_motion.col(n * times) = problem.linear_motion.col(n);
  return longer;
}

ExactAttractor attractor_motion(const ExactProblem& problem, TimeSteppingOptions stepping,
                                const CollocationOptions& options, const std::optional<PoleStart>& start) {
  const double begin = start ? start->begin : 0.0;
  const ExactProblem shifted = detail::begun_at(problem, begin);
  constexpr int most_periods = 8;
  ExactAttractor result;
  for (const double near : {1e-3, 1e-7}) {
    stepping.period_tolerance = near;
    result.settled = integrate_by_events(shifted, stepping, {}, start ? start->poles : Eigen::VectorXcd());
    const FlowMotion& settled = result.settled;
    if (settled.stepping.status == TimeSteppingStatus::cancelled) {
      result.motion = {};
      result.motion.status = ExactStatus::cancelled;
      return result;
    }
    const int periods = settled.stepping.attractor_periods;
    if (periods < 1) break;
    if (periods > most_periods && set_nearest(problem, begin, options, result)) return result;
    ExactSolution found = exact_from(problem, {begin, settled.state, settled.states}, periods, options);
    if (found.parts == nullptr && result.motion.parts != nullptr) break;
    result.motion = std::move(found);
    result.load_periods = periods;
    if (result.motion.status == ExactStatus::cancelled) return result;
    if (result.motion.parts != nullptr && result.motion.count_unstable() <= 0) break;
  }
  if (!result.motion.converged()) set_nearest(problem, begin, options, result);
  return result;
}

}  // namespace wavebalance::solvers
