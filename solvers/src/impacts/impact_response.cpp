#include "wavebalance/solvers/impacts/impact_response.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "impacts/impact_flow.hpp"
#include "impacts/impact_parts.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "wavebalance/solvers/impacts/impact_stability.hpp"

namespace wavebalance::solvers {

void ImpactResponseOptions::validate() const {
  detail::require_at_least("ImpactResponseOptions", "max_periods", max_periods, 1);
  detail::require_at_least("ImpactResponseOptions", "longest", longest, 1);
  detail::require_at_least("ImpactResponseOptions", "max_impacts", max_impacts, 1);
  detail::require_positive("ImpactResponseOptions", "near", near);
  newton.validate();
}

namespace {

// Impacts of a motion in time that nearly repeats after some periods of the load.
struct NearReturn {
  int periods = 1;
  double distance = std::numeric_limits<double>::infinity();
  std::vector<ImpactGuess> impacts;
};

// Integrates and looks for returns, of which Newton's method makes motions.
class ImpactSearch {
 public:
  ImpactSearch(const ImpactsProblem& problem, const ImpactResponseOptions& options)
      : problem_(problem),
        options_(options),
        model_(problem),
        flow_(model_, options.max_impacts),
        weights_(velocity_weights(model_)),
        best_(static_cast<std::size_t>(options.longest)),
        tried_(static_cast<std::size_t>(options.longest), std::numeric_limits<double>::infinity()) {}

  ImpactResponse run() {
    flow_.start_clear();
    states_.push_front(flow_.state());
    for (period_ = 1; period_ <= options_.max_periods; ++period_) {
      if (!goes_on(options_.observer, progress())) return ended(ImpactStatus::cancelled);
      if (!flow_.advance_period()) return ended(flow_.end());
      states_.push_front(flow_.state());
      if (states_.size() > best_.size() + 1) states_.pop_back();
      flow_.forget_before(flow_.time() - options_.longest);
      if (look_back()) return finished(std::move(found_));
    }
    return ended(ImpactStatus::not_settled);
  }

 private:
  static Eigen::VectorXd velocity_weights(const detail::ImpactModel& model) {
    return model.outputs().middleRows(model.contacts(), model.contacts()).cwiseAbs().colwise().maxCoeff();
  }
  Progress progress() const {
    return {"settling with impacts", period_, missing, {}, double(period_) / options_.max_periods};
  }

  double distance_after(int periods) const {
    const Eigen::VectorXcd change = states_.front() - states_[static_cast<std::size_t>(periods)];
    const double size = weights_.cwiseProduct(states_.front().cwiseAbs()).norm();
    return weights_.cwiseProduct(change.cwiseAbs()).norm() / std::max(size, 1e-9 * model_.velocity_scale());
  }

  // The impacts of the last periods, in shares of them.
  std::vector<ImpactGuess> last_impacts(int periods) const {
    std::vector<ImpactGuess> impacts;
    for (const auto& event : flow_.events())
      if (event.time >= flow_.time() - periods)
        impacts.push_back({event.contact, event.time / periods, event.impulse});
    return impacts;
  }

  // Whether a stable motion is found near the last periods.
  bool look_back() {
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

  bool is_motion(const NearReturn& start) {
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

  ImpactResponse solve(const NearReturn& start) const {
    ImpactResponse response;
    response.load_periods = start.periods;
    response.distance = start.distance;
    response.motion = impact_motion(problem_.over_periods(start.periods), start.impacts, options_.newton);
    if (!response.motion.converged()) return response;
    response.multipliers = impact_multipliers(response.motion);
    if (response.multipliers.size() > 0) response.unstable = unstable_count(response.multipliers);
    return response;
  }

  ImpactResponse finished(ImpactResponse response) const {
    response.integrated = std::min(period_, options_.max_periods);
    return response;
  }

  // Without a stable motion: one that is unstable, or one near the closest returns, or none.
  ImpactResponse ended(ImpactStatus status) {
    const bool named = status == ImpactStatus::chattering || status == ImpactStatus::lasting_contact;
    if (named || status == ImpactStatus::cancelled) return none(status);
    for (const NearReturn& start : best_) {
      if (found_.motion.converged()) break;
      if (!std::isfinite(start.distance) || start.impacts.empty()) continue;
      ImpactResponse response = solve(start);
      if (response.motion.converged()) found_ = std::move(response);
    }
    return found_.motion.converged() ? finished(std::move(found_)) : none(status);
  }

  ImpactResponse none(ImpactStatus status) const {
    ImpactResponse response;
    response.motion.status = status;
    const bool lasts = status == ImpactStatus::chattering || status == ImpactStatus::lasting_contact;
    if (lasts) {
      response.motion.chattering_end = period_ + flow_.end_time();
      response.motion.chattering_contact = flow_.end_contact();
    }
    return finished(std::move(response));
  }

  const ImpactsProblem& problem_;
  const ImpactResponseOptions& options_;
  detail::ImpactModel model_;
  detail::ImpactFlow flow_;
  Eigen::VectorXd weights_;
  std::deque<Eigen::VectorXcd> states_;  // at ends of periods, the last one first
  std::vector<NearReturn> best_;
  std::vector<double> tried_;  // the distance at which Newton's method was last tried
  ImpactResponse found_;
  int period_ = 0;
};

}  // namespace

ImpactResponse impact_response(const ImpactsProblem& problem, const ImpactResponseOptions& options) {
  problem.validate();
  options.validate();
  return ImpactSearch(problem, options).run();
}

}  // namespace wavebalance::solvers
