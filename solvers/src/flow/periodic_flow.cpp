#include "wavebalance/solvers/flow/periodic_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/closed_period.hpp"
#include "flow/flow_intervals.hpp"
#include "linalg/index.hpp"
#include "period/past_periods.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"

namespace wavebalance::solvers {
namespace {

Motion empty_motion(Index rows, int points) {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(rows, points);
  return {none, none, none};
}

FlowStatus sampled_period(ContactFlow& flow, Motion& motion, PeriodStart& begin, FlowMotion& result) {
  Index k = 0;
  begin = {0.0, flow.state(), flow.contact_states()};
  result.sampled_states.clear();
  const FlowStatus status = flow.advance_period(motion.points(), [&](const FlowSample& sample) {
    motion.displacement.col(k) = sample.displacement;
    motion.velocity.col(k) = sample.velocity;
    motion.force.col(k++) = sample.force;
    result.sampled_states.push_back(sample.states);
  });
  result.events = flow.events();
  result.impacts = detail::impacts_of(flow, 0.0);
  result.cycles = flow.cycles();
  result.operations += detail::period_operations(flow, int(motion.displacement.rows()));
  return status;
}

bool affords(const FlowMotion& motion, const TimeSteppingOptions& options) {
  const double each = motion.operations / motion.stepping.periods;
  return each * options.max_periods <= options.max_operations;
}

// Periods one after the other until the motion repeats.
TimeSteppingStatus run(ContactFlow& flow, const ExactProblem& problem, const TimeSteppingOptions& options,
                       PeriodStart& begin, FlowMotion& result) {
  constexpr double flow_errors = 1e-8;  // of a period
  constexpr double rounding = 1e-7;     // of the motion without contact, where a contact rests
  TimeSteppingResult& stepping = result.stepping;
  const Index rows = problem.dynamics.contacts();
  PastPeriods past(options.longest, options.period_tolerance,
                   rounding * problem.linear_motion.norm() * std::sqrt(options.output_points));
  double nearest = std::numeric_limits<double>::infinity();
  while (stepping.periods < options.max_periods) {
    Motion period = empty_motion(rows, options.output_points);
    result.ended = sampled_period(flow, period, begin, result);
    if (result.ended == FlowStatus::grows) return TimeSteppingStatus::grows;
    if (result.ended != FlowStatus::converged) return TimeSteppingStatus::step_failure;
    past.add(period.displacement);
    stepping.contacts = std::move(period);
    if (++stepping.periods > 1) stepping.period_error.push_back(past.change());
    if (stepping.periods > 1 && past.change() < nearest) {
      nearest = past.change();
      result.nearest = begin;
    }
    const int repeats = past.repeats();
    const double closer = std::log(past.change()) / std::log(options.period_tolerance),
                 done = repeats > 0 ? 1.0 : std::clamp(closer, 0.0, 1.0);
    const bool wanted = goes_on(options.observer, {"time stepping", stepping.periods, past.change(),
                                                   "relative difference of periods", done});
    if (repeats > 0) {
      stepping.attractor_periods = repeats;
      return repeats == 1 ? TimeSteppingStatus::converged : TimeSteppingStatus::subharmonic;
    }
    if (!wanted) return TimeSteppingStatus::cancelled;
    if (!affords(result, options)) return TimeSteppingStatus::iteration_limit;
  }
  if (past.change() <= flow_errors) return TimeSteppingStatus::tolerance_missed;
  if (stepping.periods > 2 * options.longest) stepping.attractor_periods = 0;
  return TimeSteppingStatus::iteration_limit;
}

// Newton's method finds the motion that was reached, unless it leads elsewhere.
void close(ContactFlow& flow, FlowMotion& result) {
  constexpr int most = 6;
  constexpr double same = 1e-5;
  const Eigen::VectorXd reached = flow.state(), weights = flow.displacements_by_state();
  const detail::ClosedPeriod closed = detail::close_period(flow, most);
  const double size = reached.cwiseProduct(weights).norm();
  const bool found = closed.found && (closed.state - reached).cwiseProduct(weights).norm() <= same * size;
  if (!found) return;
  result.closed = closed.distance;
  result.multipliers = detail::multipliers_of(flow, closed);
}

}  // namespace

FlowMotion integrate_by_events(const ExactProblem& problem, const TimeSteppingOptions& options,
                               const FlowOptions& flow_options, const Eigen::VectorXcd& poles) {
  options.validate();
  ContactFlow flow(problem, flow_options);
  if (poles.size() > 0) flow.start(poles);
  FlowMotion result;
  result.machines = flow.machines();
  PeriodStart begin;
  result.stepping.status = run(flow, problem, options, begin, result);
  result.rests = flow.rests();
  result.states = flow.contact_states();
  result.state = flow.state();
  if (result.stepping.status == TimeSteppingStatus::converged) close(flow, result);
  if (std::isfinite(result.closed)) {
    Motion period = empty_motion(problem.dynamics.contacts(), options.output_points);
    if (sampled_period(flow, period, begin, result) == FlowStatus::converged)
      result.stepping.contacts = std::move(period);
  }
  if (result.ended == FlowStatus::converged) result.motion = detail::motion_of(problem, flow, begin);
  return result;
}

FlowMotion integrate_by_events(const CondensedProblem& problem, const ContactDynamics& dynamics,
                               const ContactLaws& laws, const TimeSteppingOptions& options,
                               const FlowOptions& flow) {
  return integrate_by_events(exact_problem(problem, laws, dynamics), options, flow);
}

}  // namespace wavebalance::solvers
