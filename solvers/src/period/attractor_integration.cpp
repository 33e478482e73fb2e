#include "wavebalance/solvers/period/attractor_integration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "period/attractor_returns.hpp"
#include "period/modal_map.hpp"
#include "period/repetition.hpp"

namespace wavebalance::solvers {
namespace {

/// Result of an integration with one accuracy.
struct Verdict {
  Repetition found;   // of the states at the starts of periods of the load
  bool known = true;  // false where the operations ran out or the motion grew without bound
  bool cancelled = false;

  bool agrees(const Verdict& other) const {
    // States that approach each other belong to a spiral towards a motion of fewer periods.
    constexpr double steady = 1e-2;
    return known && other.known && found.periods == other.found.periods &&
           (found.periods <= 1 || std::abs(found.apart - other.found.apart) <= steady * found.apart);
  }
};

// Puts a period of the load that was integrated in its place, the `block`-th of a period of the problem.
void place(const Motion& period, int block, Motion& whole) {
  const Index steps = period.points();
  whole.displacement.middleCols(block * steps, steps) = period.displacement;
  whole.velocity.middleCols(block * steps, steps) = period.velocity;
  whole.force.middleCols(block * steps, steps) = period.force;
}

class AttractorIntegration {
 public:
  // `load_periods` belong to the problem, which begins `start` periods before the map.
  AttractorIntegration(ModalMap& map, PeriodState begin, int load_periods, double start, bool has_memory,
                       const AttractorOptions& options)
      : options_(options),
        map_(map),
        load_periods_(load_periods),
        start_(start),
        has_memory_(has_memory),
        states_{std::move(begin)} {}

  AttractorMotion run(const TakesReturn& takes) {
    AttractorMotion result;
    result.start = start_;
    constexpr double first = 1e2, finer = 1e-2, finest = 1e-11;
    Verdict before{{}, false};
    // Friction changes between stick and slip at many instants, each of which costs short steps.
    double tolerance = has_memory_ ? even_steps : first * options_.tolerance;
    if (!has_memory_) least_size_ = size_after_even_steps();
    for (const double share : {has_memory_ ? 0.5 : 0.4, 1.0, 1.5}) {
      limit_ = std::min(share, 1.0) * most_operations();  // each accuracy has its part
      const Verdict now =
          settled(tolerance, static_cast<int>(std::ceil(share * options_.max_periods)), result);
      result.cancelled = now.cancelled;
      if (now.agrees(before)) result.attractor_periods = now.found.periods;
      if (now.agrees(before) || !now.known) break;
      before = now;
      tolerance = tolerance == even_steps ? options_.tolerance : std::max(finest, finer * tolerance);
    }
    const bool ends = result.cancelled || result.repeats_after(load_periods_);
    if (!ends && result.integrated()) add_returns(takes, result);
    return result;
  }

 private:
  // Goes on from the last state up to `max_periods` in all, at most until the state repeats.
  Verdict settled(double tolerance, int max_periods, AttractorMotion& result) {
    constexpr std::size_t enough = 100;  // periods without a repetition, where the operations run out
    const std::size_t first = states_.size() - 1;
    RepetitionRule rule(options_.longest, options_.tolerance);
    const auto add_state = [&] {
      rule.add([&](int lag) {
        const PeriodState& before = states_[states_.size() - 1 - static_cast<std::size_t>(lag)];
        return std::min(distance(states_.back(), before), distance(before, states_.back()));
      });
    };
    add_state();
    while (result.periods < max_periods) {
      if (!add_period(tolerance, result)) return {{}, !result.grows && states_.size() - first > enough};
      add_state();
      if (const Repetition found = rule.found(); found.periods > 0) return {found};
      const Progress progress{"settling", result.periods, rule.change(), "relative change per period",
                              std::min(1.0, double(result.periods) / options_.max_periods)};
      if (!goes_on(options_.observer, progress)) return {{}, false, true};
    }
    return {};
  }

  // Size of the initial motion. From rest, errors relative to rest would use all operations.
  double size_after_even_steps() {
    const Period period = map_.advance(states_.front(), {even_steps, options_.max_operations});
    return period.complete ? map_.size(period.state) : 0.0;
  }

  bool add_period(double tolerance, AttractorMotion& result) {
    constexpr double accuracy = 10.0;  // of a step before it is extrapolated, over the tolerance
    Period period =
        map_.advance(states_.back(), {accuracy * tolerance, limit_ - map_.operations(), least_size_});
    result.grows = period.grows;
    if (!period.complete) return false;
    least_size_ = 0.0;
    const Motion& contacts = period.contacts;
    if (!result.integrated())
      result.last = {contacts.displacement.replicate(1, load_periods_),
                     contacts.velocity.replicate(1, load_periods_),
                     contacts.force.replicate(1, load_periods_)};
    place(contacts, result.periods % load_periods_, result.last);
    states_.push_back(std::move(period.state));
    ++result.periods;
    return true;
  }

  double distance(const PeriodState& one, const PeriodState& other) const {
    return (one.motion - other.motion).norm() / map_.size(one);
  }

  // The different states that nearly return after a period of the problem, the nearest first. With memory
  // the balance is solved from each as it is, which needs more of them.
  std::vector<std::size_t> nearest_returns() const {
    constexpr std::size_t transient = 20;
    const double apart = has_memory_ ? 0.25 : 1.0;
    const auto most = static_cast<std::size_t>((has_memory_ ? 3 : 1) * options_.max_returns);
    const auto period = static_cast<std::size_t>(load_periods_);
    std::vector<std::pair<double, std::size_t>> returns;
    for (std::size_t k = transient; k + period < states_.size(); ++k)
      returns.emplace_back(distance(states_[k], states_[k + period]), k);
    std::sort(returns.begin(), returns.end());
    std::vector<std::size_t> chosen;
    for (const auto& [change, k] : returns) {
      if (chosen.size() == most) break;
      const bool near =
          std::any_of(chosen.begin(), chosen.end(), [&, &change = change, &k = k](std::size_t other) {
            return distance(states_[k], states_[other]) < apart * change;
          });
      if (!near) chosen.push_back(k);
    }
    return chosen;
  }

  // The state after a period of the problem; `piece` is the motion until then, if there is one.
  std::optional<PeriodState> after_period(PeriodState state, Motion* piece = nullptr) {
    for (int i = 0; i < load_periods_; ++i) {
      Period period = map_.advance(state, {return_tolerance(), return_limit_ - map_.operations()});
      if (!period.complete) return std::nullopt;
      if (piece) place(period.contacts, i, *piece);
      state = std::move(period.state);
    }
    return state;
  }

  // The derivative of after_period(state) - state, by differences.
  std::optional<Eigen::MatrixXd> defect_slope(const PeriodState& state, const Eigen::VectorXd& end) {
    constexpr double change = 1e-5;
    const double step = change * map_.size(state);
    const Index size = end.size();
    Eigen::MatrixXd slope(size, size);
    for (Index i = 0; i < size; ++i) {
      PeriodState other = state;
      other.motion[i] += step;
      const auto other_end = after_period(map_.balanced(std::move(other)));
      if (!other_end) return std::nullopt;
      slope.col(i) = (other_end->motion - end) / step;
      slope(i, i) -= 1.0;
    }
    return slope;
  }

  // The periodic motion near a state that nearly returns, by Newton's method on the map of the period.
  std::optional<PeriodState> periodic_near(PeriodState state) {
    constexpr int max_iterations = 12;
    constexpr double least_step = 1.0 / 16.0;
    auto end = after_period(state);
    for (int i = 0; end && i < max_iterations; ++i) {
      const double defect = distance(*end, state);
      if (defect <= options_.tolerance) return state;
      const auto slope = defect_slope(state, end->motion);
      if (!slope) return std::nullopt;
      const Eigen::VectorXd change =
          detail::Lu<double>(*slope).solve(Eigen::VectorXd(end->motion - state.motion));
      std::optional<PeriodState> next_end;
      PeriodState next;
      for (double step = 1.0; step >= least_step; step *= 0.5) {
        next = map_.balanced({state.motion - step * change, state.force});
        next_end = after_period(next);
        if (!next_end || distance(*next_end, next) < defect) break;
        next_end.reset();
      }
      state = std::move(next);
      end = std::move(next_end);
    }
    return std::nullopt;
  }

  // Laws with memory have more state than the motion, and many differences of it need longer than solving
  // the balance from the return.
  PeriodState periodic_or_near(const PeriodState& state) {
    return has_memory_ ? state : periodic_near(state).value_or(state);
  }

  // A period with friction needs few.
  double most_operations() const {
    constexpr double of_friction = 1e10;
    return has_memory_ ? std::min(of_friction, options_.max_operations) : options_.max_operations;
  }

  double return_tolerance() const { return has_memory_ ? even_steps : options_.tolerance; }

  void add_returns(const TakesReturn& takes, AttractorMotion& result) {
    const double share = has_memory_ ? 1.0 : 0.4;
    return_limit_ = map_.operations() + share * most_operations();
    std::vector<PeriodState> found;
    for (const std::size_t k : nearest_returns()) {
      const double change = distance(states_[k + static_cast<std::size_t>(load_periods_)], states_[k]);
      result.cancelled = !goes_on(options_.observer,
                                  {"settling", result.periods, change, "relative change per period", 1.0});
      if (result.cancelled) return;
      const PeriodState state = periodic_or_near(states_[k]);
      const bool known = std::any_of(found.begin(), found.end(),
                                     [&](const auto& one) { return distance(one, state) <= same; });
      if (known) continue;
      found.push_back(state);
      Motion piece = result.last;
      if (!after_period(state, &piece)) return;
      result.returns.push_back(std::move(piece));
      if (takes && takes(result.returns.back(), start_)) return;
    }
  }

  static constexpr double same = 1e-4;  // distance of two states that are taken for one
  static constexpr double even_steps = std::numeric_limits<double>::infinity();  // tolerance

  const AttractorOptions& options_;
  ModalMap& map_;
  int load_periods_;
  double start_;
  bool has_memory_;
  double limit_ = 0.0, return_limit_ = 0.0;  // of operations
  double least_size_ = 0.0;                  // of the motion in its first period
  std::vector<PeriodState> states_;          // at the starts of the periods of the load
};

// The state in which the integration begins: at rest without contact forces, or the state of the options with
// the forces that the laws have there.
PeriodState initial_state(const ModalMap& map, int dofs, const AttractorOptions& options) {
  constexpr const char* who = "AttractorOptions";
  detail::require_dofs(who, "displacement", options.displacement, dofs);
  detail::require_dofs(who, "velocity", options.velocity, dofs);
  const PeriodState state = map.state(options.displacement, options.velocity);
  const bool at_rest = options.displacement.size() == 0 && options.velocity.size() == 0;
  return at_rest ? state : map.balanced(state);
}

}  // namespace

void AttractorOptions::validate() const {
  constexpr const char* who = "AttractorOptions";
  detail::require_at_least(who, "steps", steps, 1);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  detail::require_at_least(who, "longest", longest, 1);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_size", max_size, 0);
  detail::require_positive(who, "max_operations", max_operations);
  detail::require_at_least(who, "max_returns", max_returns, 0);
}

AttractorMotion settle(const CondensedProblem& problem, const ContactLaws& laws,
                       const AttractorOptions& options) {
  return settle(problem, laws, options, {});
}

AttractorMotion settle(const CondensedProblem& problem, const ContactLaws& any_laws,
                       const AttractorOptions& options, const TakesReturn& takes) {
  options.validate();
  const ContactLaws laws = any_laws.at(problem.load_frequency());
  laws.require(problem.contacts());
  const LinearStructure& structure = problem.structure();
  if (structure.size() > options.max_size || !laws.advance_in_steps()) return {};
  if (structure.is_free() && laws.act_over_period()) return {};
  const int steps = laws.act_over_period() ? std::max(1, options.steps / 4) : options.steps;
  const double frequency = load_periods(problem) * problem.frequency();
  auto flow = ModalFlow::make(structure, frequency, 1.0 / (frequency * steps), options.max_modes);
  if (!flow) return {};
  ModalMap map(problem, laws, steps, *std::move(flow));
  const double start = map.free_motion().start() / load_periods(problem);
  return AttractorIntegration(map, initial_state(map, structure.size(), options), load_periods(problem),
                              start, laws.act_over_period(), options)
      .run(takes);
}

Eigen::VectorXd resample(const Eigen::MatrixXd& by_contact, int points, double start) {
  const Index steps = by_contact.cols();
  Eigen::VectorXd samples(by_contact.rows() * points);
  for (Index c = 0; c < by_contact.rows(); ++c)
    for (int l = 0; l < points; ++l) {
      const double shifted = double(l) / points - start;
      const double at = (shifted - std::floor(shifted)) * double(steps);
      const auto before = Index(at);
      const double share = at - double(before);
      samples[c * points + l] =
          (1.0 - share) * by_contact(c, before % steps) + share * by_contact(c, (before + 1) % steps);
    }
  return samples;
}

}  // namespace wavebalance::solvers
