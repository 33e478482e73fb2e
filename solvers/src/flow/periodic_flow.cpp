#include "wavebalance/solvers/flow/periodic_flow.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "period/past_periods.hpp"
#include "phases/phase_loads.hpp"

namespace wavebalance::solvers {
namespace {

Motion empty_motion(Index rows, int points) {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(rows, points);
  return {none, none, none};
}

FlowStatus sampled_period(ContactFlow& flow, Motion& motion) {
  Index k = 0;
  return flow.advance_period(motion.points(), [&](const FlowSample& sample) {
    motion.displacement.col(k) = sample.displacement;
    motion.velocity.col(k) = sample.velocity;
    motion.force.col(k++) = sample.force;
  });
}

// Periods one after the other until the motion repeats.
TimeSteppingStatus run(ContactFlow& flow, const TimeSteppingOptions& options, Index rows,
                       FlowMotion& result) {
  TimeSteppingResult& stepping = result.stepping;
  PastPeriods past(options.longest, options.period_tolerance);
  while (stepping.periods < options.max_periods) {
    Motion period = empty_motion(rows, options.output_points);
    result.ended = sampled_period(flow, period);
    if (result.ended != FlowStatus::converged) return TimeSteppingStatus::step_failure;
    past.add(period.displacement);
    stepping.contacts = std::move(period);
    if (++stepping.periods > 1) stepping.period_error.push_back(past.change());
    if (const int repeats = past.repeats(); repeats > 0) {
      stepping.attractor_periods = repeats;
      return repeats == 1 ? TimeSteppingStatus::converged : TimeSteppingStatus::subharmonic;
    }
    const double done = std::log(past.change()) / std::log(options.period_tolerance);
    if (!goes_on(options.observer, {"time stepping", stepping.periods, past.change(),
                                    "relative difference of periods", std::clamp(done, 0.0, 1.0)}))
      return TimeSteppingStatus::cancelled;
  }
  if (stepping.periods > 2 * options.longest) stepping.attractor_periods = 0;
  return TimeSteppingStatus::iteration_limit;
}

// Perturbations of each state over one period from `state`; nothing unless the states of the contacts return.
std::optional<Eigen::MatrixXd> period_map(ContactFlow& flow, const Eigen::VectorXd& state) {
  const std::vector<int> states = flow.contact_states();
  flow.start(state);
  flow.perturb(Eigen::MatrixXd::Identity(state.size(), state.size()));
  const bool back = flow.advance_period() == FlowStatus::converged && flow.contact_states() == states;
  if (!back) return std::nullopt;
  return flow.perturbation();
}

// Memories that the period does not change have rows of the unit matrix, and those that open contacts have
// none.
Eigen::VectorXcd multipliers_of(const Eigen::MatrixXd& map) {
  std::vector<Index> kept;
  for (Index i = 0; i < map.rows(); ++i) {
    Eigen::RowVectorXd own = map.row(i);
    own[i] -= 1.0;
    if (!own.isZero(0.0)) kept.push_back(i);
  }
  const Eigen::MatrixXd free = map(kept, kept);
  return free.size() == 0 ? Eigen::VectorXcd() : detail::map_multipliers(free);
}

// Newton's method on the map of the period.
void close(ContactFlow& flow, FlowMotion& result) {
  constexpr int most = 6;
  constexpr double rounding = 1e-11, near = 1e-6;
  Eigen::VectorXd state = flow.state();
  for (int n = 0; n < most; ++n) {
    const auto map = period_map(flow, state);
    if (!map) return;
    const Eigen::VectorXd change = flow.state() - state;
    const double closed = change.norm() / std::max(state.norm(), 1e-300);
    if (!(closed < near) || (n > 0 && closed > result.closed)) return;
    result.closed = closed;
    result.multipliers = multipliers_of(*map);
    if (closed < rounding) return;
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(state.size(), state.size()) - *map;
    state += detail::least_squares(left, change);
  }
}

}  // namespace

FlowMotion integrate_by_events(const PhasesProblem& problem, const TimeSteppingOptions& options,
                               const FlowOptions& flow_options) {
  options.validate(0);
  ContactFlow flow(problem, flow_options);
  FlowMotion result;
  result.machines = flow.machines();
  result.stepping.status = run(flow, options, problem.dynamics.contacts(), result);
  result.events = flow.events();
  result.rests = flow.rests();
  if (result.stepping.status == TimeSteppingStatus::converged) close(flow, result);
  if (std::isfinite(result.closed)) {
    Motion period = empty_motion(problem.dynamics.contacts(), options.output_points);
    if (sampled_period(flow, period) == FlowStatus::converged) {
      result.stepping.contacts = std::move(period);
      result.events = flow.events();
    }
  }
  result.states = flow.contact_states();
  return result;
}

FlowMotion integrate_by_events(const CondensedProblem& problem, const ContactDynamics& dynamics,
                               const ContactLaws& laws, const TimeSteppingOptions& options,
                               const FlowOptions& flow) {
  detail::FreeContacts free(problem.structure(), problem.load_harmonics(), dynamics.holding());
  return integrate_by_events(
      PhasesProblem{dynamics, laws, free.at(problem.frequency(), problem.load_factor()), problem.frequency()},
      options, flow);
}

}  // namespace wavebalance::solvers
