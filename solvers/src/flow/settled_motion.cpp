#include "wavebalance/solvers/flow/settled_motion.hpp"

#include "flow/flow_start.hpp"
#include "linalg/index.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::solvers {
namespace {

// Far from the events of its next period.
std::optional<PeriodStart> start_of(const PhasesProblem& problem, const FlowMotion& settled) {
  constexpr double share_of_calm = 0.375;  // in the middle a contact may be about to touch
  ContactFlow flow(problem);
  flow.start(settled.state, settled.states);
  if (flow.advance_period() != FlowStatus::converged) return std::nullopt;
  return detail::calmed(problem, {0.0, settled.state, settled.states}, flow.events(), share_of_calm);
}

}  // namespace

PhasesProblem over_periods(const PhasesProblem& problem, int times) {
  PhasesProblem longer{problem.dynamics, problem.laws, {}, problem.frequency / times};
  longer.contact_free.setZero(problem.contact_free.rows(), (problem.contact_free.cols() - 1) * times + 1);
  for (Index n = 0; n < problem.contact_free.cols(); ++n)
    longer.contact_free.col(n * times) = problem.contact_free.col(n);
  return longer;
}

SettledExact settled_motion(const PhasesProblem& problem, TimeSteppingOptions stepping,
                            const ContactPhasesOptions& options, const std::optional<PoleStart>& start) {
  const double begin = start ? start->begin : 0.0;
  const PhasesProblem shifted = detail::begun_at(problem, begin);
  SettledExact result;
  for (const double near : {1e-3, 1e-7}) {
    stepping.period_tolerance = near;
    result.settled = integrate_by_events(shifted, stepping, {}, start ? start->poles : Eigen::VectorXcd());
    const int periods = result.settled.stepping.attractor_periods;
    if (result.settled.stepping.status == TimeSteppingStatus::cancelled) {
      result.motion = {};
      result.motion.status = PhasesStatus::cancelled;
    }
    if (periods < 1) return result;
    auto from = start_of(over_periods(shifted, periods), result.settled);
    if (from) from->begin += begin / periods;
    PhaseMotion found =
        from ? flow_motion_from(over_periods(problem, periods), *from, options) : PhaseMotion();
    if (found.parts == nullptr && result.motion.parts != nullptr) return result;
    result.motion = std::move(found);
    result.load_periods = periods;
    if (result.motion.status == PhasesStatus::cancelled) return result;
    if (result.motion.parts != nullptr && result.motion.count_unstable() <= 0) return result;
  }
  return result;
}

}  // namespace wavebalance::solvers
