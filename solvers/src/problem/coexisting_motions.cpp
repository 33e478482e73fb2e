#include "wavebalance/solvers/problem/coexisting_motions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/enum_table.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "problem/motion_samples.hpp"
#include "problem/state_box.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

using detail::MotionSamples, detail::points_of_period;

// A motion as reported from its integration.
UnsolvedMotion unsolved_of(const AttractorMotion& settled, int periods, ExactStatus status) {
  return {status, periods, settled.last.displacement.maxCoeff(), settled.last.force.maxCoeff(), 0};
}

bool same_as(const UnsolvedMotion& one, const UnsolvedMotion& other) {
  constexpr double same = 1e-3;  // of integrations
  const auto near = [](double a, double b) {
    return std::abs(a - b) <= same * std::max(std::abs(a), std::abs(b));
  };
  return one.periods == other.periods && near(one.max_displacement, other.max_displacement) &&
         near(one.max_force, other.max_force);
}

// The period before which a motion changed least from one period to the next, compared with how much it did
// later: there it was nearest to one that it leaves. 0 where it leaves none.
int period_before_leaving(const std::vector<double>& changes) {
  constexpr double leaves = 3.0;
  double later = 0.0, most = leaves;
  int period = 0;
  for (std::size_t k = changes.size(); k-- > 0;) {
    if (changes[k] > 0.0 && later / changes[k] > most) {
      most = later / changes[k];
      period = static_cast<int>(k) + 1;
    }
    if (std::isfinite(changes[k])) later = std::max(later, changes[k]);
  }
  return period;
}

class MotionsSearch {
 public:
  MotionsSearch(ContactProblem& problem, double frequency, const MotionsOptions& options)
      : problem_(problem), frequency_(frequency), options_(options) {}

  CoexistingMotions run() {
    if (!problem_.dynamics()) {
      result_.status = MotionsStatus::no_modes;
      return std::move(result_);
    }
    from_rest();
    from_random_states();
    between_periods();
    at_boundaries();
    describe();
    return std::move(result_);
  }

 private:
  bool watched(const Progress& progress) {
    cancelled_ = cancelled_ || !goes_on(options_.observer, progress);
    return !cancelled_;
  }

  // Overall progress from a step of one of the starts.
  Observer observer(int start) {
    return [this, start](Progress progress) {
      progress.done = double(start) / (options_.random_starts + 2);
      return watched(progress);
    };
  }

  // The problem of `periods` periods of the load.
  ContactProblem& over(int periods) {
    if (periods == 1) return problem_;
    const auto at = longer_.find(periods);
    if (at != longer_.end()) return at->second;
    return longer_.emplace(periods, problem_.over_periods(periods)).first->second;
  }

  // The motion of `periods` periods that collocation find near a start, and its number in the list if it
  // was found before or has converged now.
  template <class Start>
  std::optional<std::size_t> solve(int periods, const Start& start, MotionSource source) {
    return add(periods, over(periods).exact_near(frequency_, start, exact_options()), source);
  }

  std::optional<std::size_t> add(int periods, const std::optional<ExactSolution>& near, MotionSource source) {
    if (!near || !near->converged()) return std::nullopt;
    const MotionSamples samples = detail::samples_of(*near, periods);
    const int least = least_periods(samples);
    if (least < periods) return solve(least, first_periods(samples, least).contacts, source);
    if (const auto known = find_among(samples_, samples)) return known;
    CoexistingMotion found;
    found.motion = *near;
    found.periods = periods;
    found.stability = over(periods).stability(frequency_, *near);
    found.max_displacement = samples.contacts.displacement.maxCoeff();
    found.max_force = samples.contacts.force.maxCoeff();
    // A structure that converges to an unstable motion began near it.
    found.found_by =
        found.stability.unstable > 0 && source == MotionSource::random ? MotionSource::newton : source;
    result_.motions.push_back(std::move(found));
    samples_.push_back(samples);
    return samples_.size() - 1;
  }

  CollocationOptions exact_options() {
    return {.tolerance = options_.tolerance, .observer = observer(result_.starts)};
  }

  AttractorOptions from(const detail::StructureState& state) {
    AttractorOptions how;
    how.longest = options_.longest;
    how.max_returns = 0;
    how.displacement = state.displacement;
    how.velocity = state.velocity;
    how.observer = observer(result_.starts);
    return how;
  }

  // The motion that the structure converges to, solved for. One that was not solved for before is not tried
  // again.
  std::optional<std::size_t> settle(const AttractorOptions& how, MotionSource source) {
    const AttractorMotion settled = problem_.settle(frequency_, how);
    unsolved_ = nullptr;
    grows_ = settled.grows;
    if (settled.attractor_periods < 1) {
      near_returns(settled);
      return approached(settled, source);
    }
    const int within = load_periods(problem_.condensed());  // the load may repeat within its period
    const int periods = settled.attractor_periods / std::gcd(settled.attractor_periods, within);
    ContactProblem& problem = over(periods);
    const AttractorMotion whole = periods == 1 ? settled : problem.settle(frequency_, how);
    if (const auto known = come_to(whole, periods)) return known;
    UnsolvedMotion told = unsolved_of(whole, periods, ExactStatus::not_found);
    for (UnsolvedMotion& known : result_.unsolved)
      if (same_as(known, told)) {
        unsolved_ = &known;
        return std::nullopt;
      }
    const auto near = problem.exact_near(frequency_, whole, exact_options());
    const auto found = add(periods, near, source);
    if (found || cancelled_ || !near) return found;
    told.status = near->status;
    unsolved_ = &result_.unsolved.emplace_back(told);
    return std::nullopt;
  }

  static MotionSamples samples_of(const AttractorMotion& settled, int periods) {
    const int points = periods * points_of_period;
    const Eigen::VectorXd last = resample(settled.last.displacement, points, settled.start);
    return {{last.reshaped(points, settled.last.displacement.rows()).transpose(), {}, {}}, periods};
  }

  // The stable motion, solved for before, from which an integration that repeats differs by its integration
  // errors: solving for it again would need far longer.
  std::optional<std::size_t> come_to(const AttractorMotion& settled, int periods) const {
    constexpr double same = 1e-4;  // of what vibrates
    const auto known = find_near(samples_, samples_of(settled, periods), same);
    return known && result_.motions[*known].stability.status == "stable" ? known : std::nullopt;
  }

  // The stable motion that a structure of light damping had nearly come to when its integration ended.
  std::optional<std::size_t> approached(const AttractorMotion& settled, MotionSource source) {
    constexpr double near = 1e-2;  // of what vibrates
    if (cancelled_ || !settled.integrated()) return std::nullopt;
    if (const auto known = come_to(settled, 1)) return known;
    const UnsolvedMotion told = unsolved_of(settled, 1, ExactStatus::not_found);
    if (std::any_of(given_up_.begin(), given_up_.end(), [&](const auto& one) { return same_as(one, told); }))
      return std::nullopt;
    const auto found = solve(1, settled, source);
    if (!found) given_up_.push_back(told);
    if (!found || result_.motions[*found].stability.status != "stable") return std::nullopt;
    return find_near({samples_[*found]}, samples_of(settled, 1), near) ? found : std::nullopt;
  }

  std::optional<std::size_t> arrive(const detail::StructureState& state, MotionSource source) {
    const auto arrived = settle(from(state), source);
    if (arrived) starts_.emplace(*arrived, state);
    return arrived;
  }

  void near_returns(const AttractorMotion& settled) {
    for (const Motion& piece : settled.returns) {
      if (cancelled_) return;
      solve(1, settled.at(piece), MotionSource::newton);
    }
  }

  void from_rest() {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem_.structure().size());
    AttractorOptions how = from({});
    how.max_returns = AttractorOptions{}.max_returns;
    if (const auto arrived = settle(how, MotionSource::rest))
      starts_.emplace(*arrived, detail::StructureState{zero, zero});
    if (grows_) result_.first = ExactStatus::grows;
  }

  // The box of the motions without contact and at resonance, which holds twice those found, too.
  std::optional<detail::StateBox> box() {
    constexpr double larger = 2.0;
    auto box = detail::box_of_motions(problem_, frequency_);
    if (!box) return box;
    for (const CoexistingMotion& one : result_.motions)
      box->include(
          over(one.periods)
              .structure_motion(frequency_, one.motion, one.periods * points_of_period, {.tolerance = 1e-6})
              .motion,
          larger);
    return box;
  }

  void from_random_states() {
    if (options_.random_starts == 0 || cancelled_) return;
    const std::optional<detail::StateBox> states = box();
    if (!states) return;
    result_.box = states->sides();
    std::mt19937 generator(options_.seed);
    while (result_.starts < options_.random_starts && !cancelled_) {
      const auto arrived = arrive(states->random(generator), MotionSource::random);
      if (cancelled_) return;
      ++result_.starts;
      if (arrived)
        ++result_.motions[*arrived].arrivals;
      else if (unsolved_)
        ++unsolved_->arrivals;
      else
        ++(grows_ ? result_.none_by[ExactStatus::grows] : result_.none);
    }
  }

  // Motions that others have lost their stability to by a doubling of the period lie midway between these and
  // themselves later.
  void between_periods() {
    const std::vector<MotionSamples> found = samples_;
    for (const MotionSamples& one : found)
      for (int later = 1; later < one.periods && !cancelled_; ++later)
        if (one.periods % later == 0)
          solve(one.periods, mean_with_later(one, later).contacts, MotionSource::newton);
  }

  // From starts on both sides of the boundary between the basins of two motions.
  void at_boundaries() {
    const std::map<std::size_t, detail::StructureState> starts = starts_;
    for (auto one = starts.begin(); one != starts.end(); ++one)
      for (auto other = std::next(one); other != starts.end() && !cancelled_; ++other)
        at_boundary(one->first, other->first, one->second, other->second);
  }

  // Bisection of the states until one is so near to the boundary that the motion from there stays near it for
  // many periods, in which it comes near to an unstable motion on it.
  void at_boundary(std::size_t motion, std::size_t other, detail::StructureState inside,
                   detail::StructureState outside) {
    constexpr int halvings = 24;
    const int periods = std::lcm(result_.motions[motion].periods, result_.motions[other].periods);
    detail::StructureState middle;
    for (int i = 0; i < halvings && !cancelled_; ++i) {
      middle = {0.5 * (inside.displacement + outside.displacement),
                0.5 * (inside.velocity + outside.velocity)};
      const auto arrived = arrive(middle, MotionSource::random);
      if (arrived && result_.motions[*arrived].stability.unstable > 0) return;
      (arrived == motion ? inside : outside) = middle;
    }
    if (!cancelled_) near_boundary(middle, periods);
  }

  // The unstable motion has the period of the load, or the period of the motions on both sides.
  void near_boundary(const detail::StructureState& state, int periods) {
    constexpr int longest_stay = 60;  // periods of the load
    std::vector<double> changes;      // of each period from the one before
    AttractorOptions how = from(state);
    how.observer = [&](const Progress& progress) {
      changes.push_back(progress.value);
      return watched(progress);
    };
    problem_.settle(frequency_, how);
    if (const int nearest = period_before_leaving(changes); nearest > 0) solve_after(how, nearest, 1);
    if (periods == 1 || periods > options_.longest) return;
    const std::size_t known = samples_.size();
    const int last = std::min(longest_stay, static_cast<int>(changes.size()));
    for (int after = 2 * periods; after < last && samples_.size() == known; after += periods)
      solve_after(how, after, periods);
  }

  // From the periods of the load that end so many of them after the start.
  void solve_after(AttractorOptions& how, int after, int periods) {
    if (cancelled_) return;
    how.observer = [&](const Progress& progress) { return progress.step < after; };
    solve(periods, over(periods).settle(frequency_, how), MotionSource::newton);
  }

  void describe() {
    detail::set_shares(result_);
    for (const auto& [status, count] : result_.none_by) result_.none += count;
    if (cancelled_)
      result_.status = MotionsStatus::cancelled;
    else if (!result_.motions.empty())
      result_.status = MotionsStatus::converged;
    else if (!result_.unsolved.empty())
      result_.status = MotionsStatus::not_solved;
  }

  ContactProblem& problem_;
  double frequency_;
  const MotionsOptions& options_;
  std::map<int, ContactProblem> longer_;                  // by periods of the load
  std::vector<MotionSamples> samples_;                    // of the motions of the result
  std::map<std::size_t, detail::StructureState> starts_;  // that converge to them, the first of each
  CoexistingMotions result_;
  std::vector<UnsolvedMotion> given_up_;    // near which no motion was found
  UnsolvedMotion* unsolved_ = nullptr;      // of the result, if the last start converged to it
  bool cancelled_ = false, grows_ = false;  // the search, and the motion integrated last
};

}  // namespace

void MotionsOptions::validate() const {
  constexpr const char* who = "MotionsOptions";
  detail::require_at_least(who, "random_starts", random_starts, 0);
  detail::require_at_least(who, "longest", longest, 1);
  detail::require_positive(who, "tolerance", tolerance);
}

std::string_view to_string(MotionSource source) {
  using enum MotionSource;
  return detail::name_in<MotionSource>({{rest, "rest"}, {random, "random"}, {newton, "newton"}}, source);
}

std::string_view to_string(MotionsStatus status) {
  using enum MotionsStatus;
  return detail::name_in<MotionsStatus>({{converged, "converged"},
                                         {not_settled, "not_settled"},
                                         {not_solved, "not_solved"},
                                         {no_modes, "no_modes"},
                                         {cancelled, "cancelled"}},
                                        status);
}

CoexistingMotions coexisting_motions(ContactProblem& problem, double frequency,
                                     const MotionsOptions& options) {
  options.validate();
  if (problem.condensed().periods() != 1)
    throw std::invalid_argument("coexisting_motions: the problem is one of " +
                                std::to_string(problem.condensed().periods()) +
                                " periods of its load; expected 1");
  if ((problem.moves_by_events() || problem.laws().act_over_period()) && problem.dynamics() != nullptr)
    return event_motions(problem.exact_problem(frequency), options);
  return MotionsSearch(problem, frequency, options).run();
}

}  // namespace wavebalance::solvers
