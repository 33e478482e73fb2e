#include "wavebalance/solvers/period/settling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"
#include "period/contact_flow.hpp"

namespace wavebalance::solvers {
namespace {

/// What an integration of one accuracy ended with.
struct Verdict {
  int repeats = 0;     // periods of the load after which the state repeats; 0 for none
  double apart = 0.0;  // the least distance of states within those periods, relative
  bool known = true;   // false where the operations ran out or the motion grew without bound
  bool cancelled = false;

  bool agrees(const Verdict& other) const {
    // States that come nearer to each other are those of a spiral towards a motion of fewer periods.
    constexpr double steady = 1e-2;
    return known && other.known && repeats == other.repeats &&
           (repeats <= 1 || std::abs(apart - other.apart) <= steady * apart);
  }
};

// Puts a period of the load that was integrated in its place, the `block`-th of a period of the problem. Its
// columns are the ends of steps.
void place(const ContactFlow::Period& period, int block, ContactPeriod& whole) {
  const Eigen::Index steps = period.force.cols(), all = whole.force.cols();
  for (Eigen::Index k = 0; k < steps; ++k) {
    whole.displacement.col((block * steps + k + 1) % all) = period.displacement.col(k);
    whole.force.col((block * steps + k + 1) % all) = period.force.col(k);
  }
}

class Settling {
 public:
  Settling(const CondensedProblem& problem, const ContactLaws& laws, const SettlingOptions& options,
           ModalFlow flow)
      : options_(options), flow_(problem, laws, options.steps, std::move(flow)) {}

  SettledMotion run() {
    SettledMotion result;
    result.start = flow_.free_motion().start() / load_periods();
    states_.push_back(flow_.at_rest());
    constexpr double finer = 1e-2, finest = 1e-11;
    Verdict before{.known = false};
    double tolerance = options_.tolerance;
    for (const double share : {0.5, 1.0, 1.5}) {
      limit_ = std::min(share, 1.0) * options_.max_operations;  // each accuracy has its part
      const Verdict now =
          settled(tolerance, static_cast<int>(std::ceil(share * options_.max_periods)), result);
      result.cancelled = now.cancelled;
      if (now.agrees(before)) result.attractor_periods = now.repeats;
      if (now.agrees(before) || !now.known) break;
      before = now;
      tolerance = std::max(finest, finer * tolerance);
    }
    const bool settles = result.attractor_periods > 0 && load_periods() % result.attractor_periods == 0;
    if (!result.cancelled && !settles) add_returns(result);
    return result;
  }

 private:
  int load_periods() const { return flow_.free_motion().load_periods(); }

  // Goes on from the last state up to `max_periods` in all, at most until the state repeats.
  Verdict settled(double tolerance, int max_periods, SettledMotion& result) {
    constexpr int transient = 50;  // before a motion is taken for one of several periods
    // A spiral towards a motion of fewer periods comes near past states too, and nearly as near later ones.
    constexpr double apart = 100.0;
    constexpr std::size_t enough = 100;  // periods without a repetition, where the operations run out
    const std::size_t first = states_.size() - 1;
    Verdict verdict;
    while (result.periods < max_periods) {
      if (!add_period(tolerance, result)) return {.known = states_.size() - first > enough};
      verdict = repeated(first);
      const bool subharmonic = verdict.repeats > 1 && verdict.apart > apart * options_.tolerance;
      if (verdict.repeats == 1 || (subharmonic && states_.size() - first > transient)) return verdict;
      verdict.repeats = 0;
      const double change = distance(states_.back(), states_[states_.size() - 2]);
      const Progress progress{"settling", result.periods, change, "relative change per period",
                              std::min(1.0, double(result.periods) / options_.max_periods)};
      if (!goes_on(options_.observer, progress)) return {.known = false, .cancelled = true};
    }
    return verdict;
  }

  bool add_period(double tolerance, SettledMotion& result) {
    constexpr double accuracy = 10.0;  // of a step before it is extrapolated, over the tolerance
    ContactFlow::Period period =
        flow_.period_from(states_.back(), accuracy * tolerance, limit_ - flow_.operations());
    if (!period.complete) return false;
    if (!result.integrated())
      result.last = {period.displacement.replicate(1, load_periods()),
                     period.force.replicate(1, load_periods())};
    place(period, result.periods % load_periods(), result.last);
    states_.push_back(std::move(period.end));
    ++result.periods;
    return true;
  }

  double distance(const ContactFlow::State& one, const ContactFlow::State& other) const {
    return (one.deviation - other.deviation).norm() / flow_.size(one);
  }

  // After how many periods the last state repeats one since `first`, the latest of them.
  Verdict repeated(std::size_t first) const {
    Verdict verdict;
    const std::size_t last = states_.size() - 1,
                      longest = std::min(last - first, static_cast<std::size_t>(options_.longest));
    for (std::size_t lag = 1; lag <= longest && verdict.repeats == 0; ++lag)
      if (distance(states_[last], states_[last - lag]) <= options_.tolerance)
        verdict.repeats = static_cast<int>(lag);
    verdict.apart = least_distance(static_cast<std::size_t>(verdict.repeats));
    return verdict;
  }

  // Between any two of the last states, so that it is the same whichever of them comes last.
  double least_distance(std::size_t count) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i <= count; ++i)
      for (std::size_t j = 1; j < i; ++j)
        least = std::min({least, distance(states_[states_.size() - i], states_[states_.size() - j]),
                          distance(states_[states_.size() - j], states_[states_.size() - i])});
    return least;
  }

  // Of the states that nearly return after a period of the problem, the nearest first, those that differ.
  std::vector<std::size_t> nearest_returns() const {
    constexpr std::size_t transient = 20;
    const auto period = static_cast<std::size_t>(load_periods());
    std::vector<std::pair<double, std::size_t>> returns;
    for (std::size_t k = transient; k + period < states_.size(); ++k)
      returns.emplace_back(distance(states_[k], states_[k + period]), k);
    std::sort(returns.begin(), returns.end());
    std::vector<std::size_t> chosen;
    for (const auto& [change, k] : returns) {
      if (chosen.size() == static_cast<std::size_t>(options_.max_returns)) break;
      const bool near =
          std::any_of(chosen.begin(), chosen.end(), [&, &change = change, &k = k](std::size_t other) {
            return distance(states_[k], states_[other]) < change;
          });
      if (!near) chosen.push_back(k);
    }
    return chosen;
  }

  // The state after a period of the problem; `piece` is the motion until then, if there is one.
  std::optional<ContactFlow::State> after_period(ContactFlow::State state, ContactPeriod* piece = nullptr) {
    for (int i = 0; i < load_periods(); ++i) {
      ContactFlow::Period period =
          flow_.period_from(state, options_.tolerance, return_limit_ - flow_.operations());
      if (!period.complete) return std::nullopt;
      if (piece) place(period, i, *piece);
      state = std::move(period.end);
    }
    return state;
  }

  // The derivative of after_period(state) - state, by differences.
  std::optional<Eigen::MatrixXd> defect_slope(const ContactFlow::State& state, const Eigen::VectorXd& end) {
    constexpr double change = 1e-5;
    const double step = change * flow_.size(state);
    const Eigen::Index size = end.size();
    Eigen::MatrixXd slope(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      ContactFlow::State other = state;
      other.deviation[i] += step;
      const auto other_end = after_period(flow_.balanced(std::move(other)));
      if (!other_end) return std::nullopt;
      slope.col(i) = (other_end->deviation - end) / step;
      slope(i, i) -= 1.0;
    }
    return slope;
  }

  // The periodic motion near a state that nearly returns, by Newton's method on the map of the period.
  std::optional<ContactFlow::State> periodic_near(ContactFlow::State state) {
    constexpr int max_iterations = 12;
    constexpr double least_step = 1.0 / 16.0;
    auto end = after_period(state);
    for (int i = 0; end && i < max_iterations; ++i) {
      const double defect = distance(*end, state);
      if (defect <= options_.tolerance) return state;
      const auto slope = defect_slope(state, end->deviation);
      if (!slope) return std::nullopt;
      const Eigen::VectorXd change =
          detail::Lu<double>(*slope).solve(Eigen::VectorXd(end->deviation - state.deviation));
      std::optional<ContactFlow::State> next_end;
      ContactFlow::State next;
      for (double step = 1.0; step >= least_step; step *= 0.5) {
        next = flow_.balanced({state.deviation - step * change, state.force});
        next_end = after_period(next);
        if (!next_end || distance(*next_end, next) < defect) break;
        next_end.reset();
      }
      state = std::move(next);
      end = std::move(next_end);
    }
    return std::nullopt;
  }

  void add_returns(SettledMotion& result) {
    if (!result.integrated()) return;
    return_limit_ = flow_.operations() + options_.max_operations;
    std::vector<ContactFlow::State> found;
    for (const std::size_t k : nearest_returns()) {
      const double change = distance(states_[k + static_cast<std::size_t>(load_periods())], states_[k]);
      result.cancelled = !goes_on(options_.observer,
                                  {"settling", result.periods, change, "relative change per period", 1.0});
      if (result.cancelled) return;
      const ContactFlow::State state = periodic_near(states_[k]).value_or(states_[k]);
      const bool known = std::any_of(found.begin(), found.end(),
                                     [&](const auto& one) { return distance(one, state) <= same; });
      if (known) continue;
      found.push_back(state);
      ContactPeriod piece = result.last;
      if (!after_period(state, &piece)) return;
      result.returns.push_back(std::move(piece));
    }
  }

  static constexpr double same = 1e-4;  // distance of two states that are taken for one

  const SettlingOptions& options_;
  ContactFlow flow_;
  double limit_ = 0.0, return_limit_ = 0.0;  // of operations
  std::vector<ContactFlow::State> states_;   // at the starts of the periods of the load
};

}  // namespace

void SettlingOptions::validate() const {
  constexpr const char* who = "SettlingOptions";
  detail::require_at_least(who, "steps", steps, 1);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  detail::require_at_least(who, "longest", longest, 1);
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_modes", max_modes, 1);
  detail::require_at_least(who, "max_size", max_size, 0);
  detail::require_positive(who, "max_operations", max_operations);
  detail::require_at_least(who, "max_returns", max_returns, 0);
}

SettledMotion settle(const CondensedProblem& problem, const ContactLaws& laws,
                     const SettlingOptions& options) {
  options.validate();
  laws.require(problem.contacts());
  const LinearStructure& structure = problem.structure();
  if (structure.size() > options.max_size || structure.is_free()) return {};
  const double frequency = load_periods(problem) * problem.frequency();
  const double step = 1.0 / (frequency * options.steps);
  auto flow = ModalFlow::make(structure, frequency, step, options.max_modes);
  if (!flow) return {};
  return Settling(problem, laws, options, *std::move(flow)).run();
}

Eigen::VectorXd resample(const Eigen::MatrixXd& by_contact, int points, double start) {
  const Eigen::Index steps = by_contact.cols();
  Eigen::VectorXd samples(by_contact.rows() * points);
  for (Eigen::Index c = 0; c < by_contact.rows(); ++c)
    for (int l = 0; l < points; ++l) {
      const double shifted = double(l) / points - start;
      const double at = (shifted - std::floor(shifted)) * double(steps);
      const auto before = static_cast<Eigen::Index>(at);
      const double share = at - double(before);
      samples[c * points + l] =
          (1.0 - share) * by_contact(c, before % steps) + share * by_contact(c, (before + 1) % steps);
    }
  return samples;
}

}  // namespace wavebalance::solvers
