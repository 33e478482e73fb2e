#include "impacts/lasting_motion.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>

#include "impacts/impact_flow.hpp"
#include "impacts/impact_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "wavebalance/solvers/impacts/impact_stability.hpp"

namespace wavebalance::solvers::detail {
namespace {

double share_of(double time) {
  const double share = time - std::floor(time);
  return share < 1.0 ? share : 0.0;
}

// Sizes of the states by the velocities of the contacts that they make.
Eigen::VectorXd weights_of(const LastingFlow& flow) {
  return flow.poles().free_velocity(0.0).cwiseAbs().colwise().maxCoeff();
}

double weighted(const Eigen::VectorXd& weights, const Eigen::VectorXd& states) {
  return weights.cwiseProduct(states).norm();
}

// What Newton's method on the map of a period ends with.
struct LastingNewton {
  Eigen::VectorXd states;
  Eigen::MatrixXd monodromy;
  double residual = std::numeric_limits<double>::infinity();
  int iterations = 0;
};

bool map_period(LastingFlow& flow, const Eigen::VectorXd& states, double time, LastingState& end,
                Eigen::MatrixXd& monodromy) {
  end = {states, time, -1};
  monodromy = Eigen::MatrixXd::Identity(states.size(), states.size());
  return flow.advance(end, 1.0, nullptr, &monodromy) && end.closed < 0;
}

// Until the residual stays at rounding.
LastingNewton newton(LastingFlow& flow, Eigen::VectorXd states, double time, int max_iterations) {
  const Eigen::VectorXd weights = weights_of(flow);
  LastingNewton best;
  LastingState end;
  Eigen::MatrixXd monodromy;
  for (int k = 0; k < max_iterations; ++k) {
    if (!map_period(flow, states, time, end, monodromy)) return best;
    const Eigen::VectorXd change = end.states - states;
    const double residual = weighted(weights, change) / flow.model().velocity_scale();
    if (!(residual < best.residual)) return best;
    best = {states, monodromy, residual, k};
    const Lu<double> factors(Eigen::MatrixXd::Identity(states.size(), states.size()) - monodromy);
    if (factors.is_singular()) return best;
    states += factors.solve(change);
  }
  return best;
}

void order_by_time(ImpactMotion& motion) {
  for (Impact& impact : motion.impacts) impact.time = share_of(impact.time);
  std::ranges::stable_sort(motion.impacts, {}, &Impact::time);
  for (LastingContact& contact : motion.lasting) {
    const double length = contact.end - contact.begin;
    contact.begin = share_of(contact.begin);
    contact.end = contact.begin + length;
  }
  std::ranges::stable_sort(motion.lasting, {}, &LastingContact::begin);
}

}  // namespace

LastingParts::At LastingParts::at(double share) const {
  const double first = segments.front().begin, time = first + share_of(share - first);
  const auto after =
      std::ranges::upper_bound(segments, time, {}, [](const LastingSegment& one) { return one.begin; });
  const LastingSegment& segment = *std::prev(after);
  const double seconds = (time - segment.begin) * model->period();
  At result;
  result.force = Eigen::VectorXd::Zero(model->contacts());
  Eigen::VectorXcd states;
  if (segment.closed < 0) {
    states = model->growth(seconds).cwiseProduct(segment.state);
  } else {
    const ClosedModes& modes = *flow->closed(segment.closed);
    const Eigen::VectorXcd now = modes.after(segment.state, seconds);
    states = flow->complex_of(modes.states_of(now, time));
    result.force[segment.closed] = modes.force(now, time);
  }
  const ContactState motion = model->motion(states, time);
  result.displacement = motion.displacement;
  result.velocity = motion.velocity;
  return result;
}

void LastingParts::add_harmonics(Eigen::MatrixXcd& harmonics) const {
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].closed < 0) continue;
    const double end = i + 1 < segments.size() ? segments[i + 1].begin : segments.front().begin + 1.0;
    flow->closed(segments[i].closed)
        ->add_harmonics(segments[i].state, segments[i].begin, end - segments[i].begin, harmonics);
  }
}

ImpactMotion lasting_motion(const std::shared_ptr<const ImpactModel>& model, const Eigen::VectorXd& states,
                            double time, int max_iterations) {
  constexpr double rounding = 1e-9;
  auto parts = std::make_shared<LastingParts>();
  parts->model = model;
  parts->flow = std::make_shared<LastingFlow>(*model);
  const LastingNewton solved = newton(*parts->flow, states, time, max_iterations);
  ImpactMotion motion;
  motion.status = ImpactStatus::iteration_limit;
  motion.iterations = solved.iterations;
  if (!(solved.residual <= rounding)) return motion;
  LastingRecord record;
  LastingState end{solved.states, time, -1};
  if (!parts->flow->advance(end, 1.0, &record, nullptr)) return motion;
  parts->segments = std::move(record.segments);
  parts->multipliers = map_multipliers(solved.monodromy);
  motion.impacts = std::move(record.impacts);
  motion.lasting = std::move(record.contacts);
  order_by_time(motion);
  motion.residual = solved.residual;
  motion.model = model;
  motion.parts = std::move(parts);
  motion.status = ImpactStatus::converged;
  return motion;
}

namespace {

// The middle of the longest flight of the next period from a state on, and the state there.
std::optional<LastingState> in_flight(LastingFlow& flow, const LastingState& from, double periods) {
  LastingRecord record;
  LastingState end = from;
  if (!flow.advance(end, periods, &record, nullptr)) return std::nullopt;
  double longest = 0.0, middle = 0.0;
  for (std::size_t i = 0; i < record.segments.size(); ++i) {
    const double begin = record.segments[i].begin,
                 until = i + 1 < record.segments.size() ? record.segments[i + 1].begin : end.time;
    if (record.segments[i].closed >= 0 || until - begin <= longest) continue;
    longest = until - begin;
    middle = begin + 0.5 * longest;
  }
  LastingState at = from;
  if (longest == 0.0 || !flow.advance(at, middle - from.time, nullptr, nullptr) || at.closed >= 0)
    return std::nullopt;
  return at;
}

ImpactResponse solved_after(const ImpactsProblem& problem, LastingFlow& flow, const LastingState& state,
                            int periods, const ImpactResponseOptions& options) {
  ImpactResponse response;
  const std::optional<LastingState> start = in_flight(flow, state, periods);
  if (!start) return response;
  const auto model = std::make_shared<const ImpactModel>(problem.over_periods(periods));
  response.motion =
      lasting_motion(model, start->states, start->time / periods, options.newton.max_iterations);
  response.load_periods = periods;
  if (!response.motion.converged()) return response;
  if (const int fewer = repeats_after(response.motion, periods); fewer < periods)
    return solved_after(problem, flow, state, fewer, options);
  if (response.motion.lasting.empty()) {  // on the way alone contact lasted
    std::vector<ImpactGuess> impacts;
    for (const Impact& one : response.motion.impacts) impacts.push_back({one.contact, one.time, one.impulse});
    response.motion = impact_motion(problem.over_periods(periods), impacts, options.newton);
    if (!response.motion.converged()) return response;
  }
  response.multipliers = impact_multipliers(response.motion);
  response.unstable = unstable_count(response.multipliers);
  return response;
}

LastingState first_state(const ImpactModel& model, const LastingFlow& flow,
                         const ImpactResponseOptions& options) {
  ImpactFlow clear(model, options.max_impacts);
  if (options.start.size() == 0)
    clear.start_clear();
  else
    clear.start(options.start, 0.0);
  return {flow.real_of(clear.state()), clear.time(), -1};
}

}  // namespace

ImpactResponse lasting_response(const ImpactsProblem& problem, const ImpactResponseOptions& options) {
  constexpr double near = 1e-5;
  const ImpactModel model(problem);
  LastingFlow flow(model);
  const Eigen::VectorXd weights = weights_of(flow);
  LastingState state = first_state(model, flow, options);
  std::deque<Eigen::VectorXd> history{state.states};
  ImpactResponse response;
  for (int period = 1; period <= options.max_periods; ++period) {
    response.integrated = period;
    const Progress progress{
        "settling with contact that lasts", period, missing, {}, double(period) / options.max_periods};
    if (!goes_on(options.observer, progress)) {
      response.motion.status = ImpactStatus::cancelled;
      return response;
    }
    if (!flow.advance(state, 1.0, nullptr, nullptr)) {
      response.motion.status = flow.end();
      return response;
    }
    state.time -= 1.0;
    for (int n = 1; n <= static_cast<int>(history.size()); ++n) {
      const double distance = weighted(weights, state.states - history[static_cast<std::size_t>(n - 1)]) /
                              std::max(weighted(weights, state.states), 1e-9 * model.velocity_scale());
      if (distance > near) continue;
      ImpactResponse found = solved_after(problem, flow, state, n, options);
      found.integrated = period;
      found.distance = distance;
      if (found.motion.converged() && found.unstable == 0) return found;
      break;
    }
    history.push_front(state.states);
    if (static_cast<int>(history.size()) > options.longest) history.pop_back();
  }
  response.motion.status = ImpactStatus::not_settled;
  return response;
}

}  // namespace wavebalance::solvers::detail
