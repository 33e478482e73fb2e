#include "impacts/impact_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "impacts/impact_parts.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"
#include "wavebalance/solvers/flow/attractor_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

Eigen::VectorXd velocity_weights(const ImpactModel& model) {
  return model.outputs(1).cwiseAbs().colwise().maxCoeff();
}

}  // namespace

ImpactSearch::ImpactSearch(const ExactProblem& problem, const ImpactResponseOptions& options)
    : problem_(problem),
      options_(options),
      model_(problem),
      flow_(model_),
      weights_(velocity_weights(model_)),
      best_(static_cast<std::size_t>(options.longest)),
      tried_(static_cast<std::size_t>(options.longest), std::numeric_limits<double>::infinity()) {}

ImpactResponse ImpactSearch::run() {
  flow_.start(options_.start);
  states_.push_front(flow_.state());
  for (period_ = 1; period_ <= options_.max_periods; ++period_) {
    if (!goes_on(options_.observer, progress())) return ended(ExactStatus::cancelled);
    if (!flow_.advance_period()) return ended(flow_.end());
    states_.push_front(flow_.state());
    if (states_.size() > best_.size() + 1) states_.pop_back();
    flow_.forget_before(flow_.time() - options_.longest);
    if (look_back()) return finished(found_);
  }
  return ended(ExactStatus::not_settled);
}

Progress ImpactSearch::progress() const {
  return {"settling with impacts", period_, missing, {}, double(period_) / options_.max_periods};
}

double ImpactSearch::distance_after(int periods) const {
  const Eigen::VectorXcd change = states_.front() - states_[static_cast<std::size_t>(periods)];
  const double size = weights_.cwiseProduct(states_.front().cwiseAbs()).norm();
  return weights_.cwiseProduct(change.cwiseAbs()).norm() / std::max(size, 1e-9 * model_.velocity_scale());
}

// The impacts of the last periods, in shares of them.
std::vector<ImpactGuess> ImpactSearch::last_impacts(int periods) const {
  std::vector<ImpactGuess> impacts;
  for (const auto& event : flow_.events())
    if (event.time >= flow_.time() - periods)
      impacts.push_back({event.contact, event.time / periods, event.impulse});
  return impacts;
}

// Whether a stable motion is found near the last periods.
bool ImpactSearch::look_back() {
  const int most = std::min<int>(options_.longest, static_cast<int>(states_.size()) - 1);
  for (int n = 1; n <= most; ++n) {
    const double distance = distance_after(n);
    auto& best = best_[static_cast<std::size_t>(n - 1)];
    if (distance < best.distance) best = {n, distance, last_impacts(n)};
    if (distance > options_.near) continue;
    if (is_motion({n, distance, last_impacts(n)})) return true;
    break;  // longer ones would be the same motion
  }
  return false;
}

bool ImpactSearch::is_motion(const NearReturn& start) {
  constexpr double much_closer = 0.1, arrived = 1e-9;
  double& tried = tried_[static_cast<std::size_t>(start.periods - 1)];
  if (start.distance > much_closer * tried && start.distance > arrived) return false;
  tried = start.distance;
  ImpactResponse response = solve(start);
  if (!response.motion.converged()) return false;
  const bool accepted = response.unstable == 0 || start.distance <= arrived;
  if (accepted || !found_.motion.converged()) found_ = std::move(response);
  return accepted;
}

ImpactResponse ImpactSearch::solve(const NearReturn& start) const {
  ImpactResponse response;
  response.load_periods = start.periods;
  response.distance = start.distance;
  response.motion = impact_motion(over_periods(problem_, start.periods), start.impacts);
  if (!response.motion.converged()) return response;
  if (const int fewer = repeats_after(response.motion.impacts, start.periods); fewer < start.periods) {
    NearReturn shorter{fewer, start.distance, {}};
    for (const Impact& impact : response.motion.impacts)
      if (impact.time * start.periods < fewer)
        shorter.impacts.push_back({impact.contact, impact.time * start.periods / fewer, impact.impulse});
    return solve(shorter);
  }
  set_multipliers(response);
  return response;
}

void ImpactSearch::set_multipliers(ImpactResponse& response) {
  response.multipliers = response.motion.multipliers();
  response.unstable = count_outside(response.multipliers);
}

// The exact motion with contact that lasts, from the first state.
ImpactResponse ImpactSearch::resting(ExactStatus status) const {
  TimeSteppingOptions stepping;
  stepping.max_periods = options_.max_periods;
  stepping.longest = options_.longest;
  stepping.observer = options_.observer;
  ImpactFlow clear(model_);
  clear.start(options_.start);
  ExactAttractor settled = attractor_motion(problem_, stepping, {.observer = options_.observer},
                                            PoleStart{clear.time(), clear.state()});
  ImpactResponse response = none(status);
  response.integrated = settled.settled.stepping.periods;
  response.load_periods = settled.load_periods;
  if (settled.motion.status == ExactStatus::cancelled) response.motion.status = ExactStatus::cancelled;
  if (settled.motion.parts == nullptr) return response;
  response.motion = std::move(settled.motion);
  set_multipliers(response);
  return response;
}

std::vector<ImpactResponse> ImpactSearch::near_returns() const {
  constexpr double far = 0.5;
  std::vector<ImpactResponse> motions;
  for (const NearReturn& start : best_) {
    if (!(start.distance < far)) continue;
    ImpactResponse response = solve(start);
    if (response.motion.converged()) motions.push_back(finished(std::move(response)));
  }
  return motions;
}

ImpactResponse ImpactSearch::finished(ImpactResponse response) const {
  response.integrated = std::min(period_, options_.max_periods);
  return response;
}

// Without a stable motion: one that is unstable, or one near the closest returns, or none.
ImpactResponse ImpactSearch::ended(ExactStatus status) {
  const bool named = status == ExactStatus::chattering || status == ExactStatus::lasting_contact ||
                     status == ExactStatus::grazing;
  if (status == ExactStatus::cancelled) return none(status);
  const ImpactResponse rests = named ? resting(status) : none(status);
  if (rests.motion.converged() || rests.motion.status == ExactStatus::cancelled) return rests;
  for (const NearReturn& start : best_) {
    if (found_.motion.converged()) break;
    if (!std::isfinite(start.distance) || start.impacts.empty()) continue;
    ImpactResponse response = solve(start);
    if (response.motion.converged()) found_ = std::move(response);
  }
  const bool rests_stably = rests.moves() && rests.unstable == 0,
             better = found_.motion.converged() && (found_.unstable == 0 || !rests_stably);
  return better ? finished(found_) : rests;
}

ImpactResponse ImpactSearch::none(ExactStatus status) const {
  ImpactResponse response;
  response.motion.status = status;
  const bool lasts = status == ExactStatus::chattering || status == ExactStatus::lasting_contact;
  if (lasts) {
    response.chattering_end = period_ + flow_.end_time();
    response.chattering_contact = flow_.end_contact();
  }
  return finished(std::move(response));
}

}  // namespace wavebalance::solvers::detail
