#include "stability/stop_motion.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/multipliers.hpp"
#include "stability/floquet_determinant.hpp"
#include "stability/smooth_segments.hpp"
#include "stability/stability_checks.hpp"

namespace wavebalance::solvers {
namespace {

using detail::HeldByStops, detail::LinearFlow, detail::LinearStops, detail::Waves;
using HeldFinder = std::function<const HeldByStops*(const std::vector<int>& closed)>;

struct StopChange {
  double time;  // s, from the origin
  int stop;
};

// Which stops are closed in a period from the origin on.
struct StopPattern {
  std::vector<int> closed;  // at the origin, ascending
  std::vector<StopChange> changes;
};

void toggle(std::vector<int>& closed, int stop) {
  const auto at = std::lower_bound(closed.begin(), closed.end(), stop);
  if (at != closed.end() && *at == stop)
    closed.erase(at);
  else
    closed.insert(at, stop);
}

bool is_in(const std::vector<int>& closed, int stop) {
  return std::binary_search(closed.begin(), closed.end(), stop);
}

StopPattern pattern_of(const std::vector<ContactInterval>& intervals, double origin, double period) {
  StopPattern pattern;
  for (const ContactInterval& interval : intervals) {
    if (lies_in(interval, origin)) toggle(pattern.closed, interval.contact);
    if (interval.always()) continue;
    for (const double time : {interval.begin, interval.end})
      pattern.changes.push_back({period * (time - origin - std::floor(time - origin)), interval.contact});
  }
  std::sort(pattern.changes.begin(), pattern.changes.end(),
            [](const StopChange& a, const StopChange& b) { return a.time < b.time; });
  return pattern;
}

// Changes at one instant have no order.
bool is_same(StopPattern a, StopPattern b, double within) {
  const auto by_stop = [](const StopChange& p, const StopChange& q) {
    return std::pair(p.stop, p.time) < std::pair(q.stop, q.time);
  };
  std::sort(a.changes.begin(), a.changes.end(), by_stop);
  std::sort(b.changes.begin(), b.changes.end(), by_stop);
  return a.closed == b.closed && std::equal(a.changes.begin(), a.changes.end(), b.changes.begin(),
                                            b.changes.end(), [&](const StopChange& p, const StopChange& q) {
                                              return p.stop == q.stop && std::abs(p.time - q.time) <= within;
                                            });
}

// A part of a motion in which the same stops are closed.
struct StopFlight {
  double begin;  // s, from the origin
  const LinearFlow* flow;
  Eigen::VectorXcd modal;  // at its beginning

  Eigen::ArrayXcd modal_at(double time) const {
    return modal.array() * ((time - begin) * flow->exponents.array()).exp();
  }
};

// The distances of all stops from their gaps and their rates, and bounds of the second derivatives later.
struct StopLooks {
  explicit StopLooks(const LinearFlow& flow)
      : weights(flow.outputs),
        of_rates(flow.outputs * flow.exponents.asDiagonal()),
        of_bounds((flow.outputs * flow.exponents.cwiseAbs2().asDiagonal()).cwiseAbs()),
        growth(std::max(0.0, flow.exponents.real().maxCoeff())) {}

  // Seconds within which the stop does not pass its gap.
  double safe_step(int stop, bool closed, const Eigen::ArrayXcd& modal, const Eigen::ArrayXd& sizes) const {
    const double side = closed ? 1.0 : -1.0,
                 bound =
                     (growth > 0.0 ? std::numbers::e : 1.0) * (of_bounds.row(stop) * sizes.matrix()).value(),
                 apart = std::max(0.0, side * (weights.row(stop) * modal.matrix()).value().real()),
                 rate = side * (of_rates.row(stop) * modal.matrix()).value().real(),
                 root = std::sqrt(rate * rate + 2.0 * bound * apart);
    const double step = rate > 0.0 ? (rate + root) / bound : 2.0 * apart / (root - rate);
    return growth > 0.0 ? std::min(step, 1.0 / growth) : step;
  }

  Eigen::MatrixXcd weights, of_rates;
  Eigen::MatrixXd of_bounds;
  double growth;
};

class StopSearch {
 public:
  StopSearch(HeldFinder held, const LinearStops& stops, Waves waves)
      : held_(std::move(held)), stops_(stops), waves_(std::move(waves)) {}

  // The map of the motion near a pattern, whose flights are then known; nothing where none is found. A map
  // costs much more than following the motion. It is kept while each step takes three quarters of the defect
  // away.
  std::optional<Eigen::MatrixXd> near(StopPattern pattern) {
    constexpr int most = 40;
    constexpr double settled = 1e-9, most_left = 0.25;
    double before = std::numeric_limits<double>::infinity();
    std::optional<Eigen::MatrixXd> map = close(pattern);
    bool current = true;  // whether the map belongs to the pattern
    for (int n = 0; map && n < most; ++n) {
      std::optional<StopPattern> next = follow(pattern.closed);
      if (!next) return std::nullopt;
      const bool same = is_same(*next, pattern, settled * waves_.period);
      if (same && current) return map;
      pattern = *std::move(next);
      const Eigen::VectorXd defect = (end_ - state_).head(map->rows());
      current = same || !(defect.norm() <= most_left * before);
      before = defect.norm();
      if (current)
        map = close(pattern);
      else
        state_.head(map->rows()) += fixed_.solve(defect);
    }
    return std::nullopt;
  }

  // Displacements beyond the gaps of the motion that was followed, at a time of the period.
  Eigen::VectorXd apart(double time) const {
    const auto after = std::find_if(flights_.begin() + 1, flights_.end(),
                                    [&](const StopFlight& one) { return one.begin > time; });
    const StopFlight& flight = *(after - 1);
    return (flight.flow->outputs * flight.modal_at(time).matrix()).real();
  }

 private:
  const LinearFlow* flow(const std::vector<int>& closed) {
    const auto known = flows_.find(closed);
    if (known != flows_.end()) return &known->second;
    const HeldByStops* held = held_(closed);
    return held ? &flows_.emplace(closed, held->under(waves_)).first->second : nullptr;
  }

  // Sets the state at the origin of the motion that is periodic with a pattern, and returns its map.
  std::optional<Eigen::MatrixXd> close(const StopPattern& pattern) {
    std::vector<int> closed = pattern.closed;
    const LinearFlow* here = flow(closed);
    if (!here) return std::nullopt;
    Eigen::MatrixXd passed = here->left;  // as modal states
    double time = 0.0;
    for (const StopChange& change : pattern.changes) {
      here->advance(change.time - time, passed);
      time = change.time;
      toggle(closed, change.stop);
      const LinearFlow* next = flow(closed);
      if (!next) return std::nullopt;
      passed = detail::product(between(*here, *next), passed);
      here = next;
    }
    here->advance(waves_.period - time, passed);
    passed = detail::product(here->right, passed);
    const Eigen::VectorXd waves = wave_states_at_origin();
    const Index states = passed.rows() - waves.size();
    Eigen::MatrixXd map = passed.topLeftCorner(states, states);
    fixed_.compute(Eigen::MatrixXd::Identity(states, states) - map);
    state_.resize(passed.rows());
    state_ << fixed_.solve(Eigen::VectorXd(passed.topRightCorner(states, waves.size()) * waves)), waves;
    return state_.allFinite() ? std::optional(std::move(map)) : std::nullopt;
  }

  // From the modal states of one flow to the next one's.
  const Eigen::MatrixXd& between(const LinearFlow& one, const LinearFlow& next) {
    const auto [at, made] = between_.try_emplace({&one, &next});
    if (made) at->second = detail::product(next.left, one.right);
    return at->second;
  }

  Eigen::VectorXd wave_states_at_origin() const {
    std::vector<double> states;
    for (const double order : waves_.orders) {
      states.push_back(1.0);
      if (order != 0.0) states.push_back(0.0);
    }
    return Eigen::Map<const Eigen::VectorXd>(states.data(), Index(states.size()));
  }

  // The pattern of the motion from the state at the origin, with the same stops closed if they can be.
  std::optional<StopPattern> follow(std::vector<int> closed) {
    constexpr std::size_t most = 1000;
    if (!settle(closed)) return std::nullopt;
    StopPattern pattern{closed, {}};
    flights_.clear();
    Eigen::VectorXd state = state_;
    for (double time = 0.0; pattern.changes.size() < most;) {
      const LinearFlow* here = flow(closed);
      if (!here) return std::nullopt;
      flights_.push_back({time, here, here->modes.complex_of(here->left * state)});
      const std::optional<StopChange> change = next_change(flights_.back(), closed);
      if (!change) return std::nullopt;
      time = change->time;
      state = here->right * here->modes.real_of(flights_.back().modal_at(time).matrix());
      if (change->stop < 0) {
        end_ = std::move(state);
        return pattern;
      }
      pattern.changes.push_back(*change);
      toggle(closed, change->stop);
    }
    return std::nullopt;
  }

  // Closes and opens stops until all are on the side of their gaps on which they should be.
  bool settle(std::vector<int>& closed) {
    for (Index n = 0; n <= 4 * stops_.gap.size(); ++n) {
      const LinearFlow* here = flow(closed);
      if (!here) return false;
      const Eigen::VectorXd apart = (here->outputs * here->modes.complex_of(here->left * state_)).real();
      int worst = -1;
      for (int stop = 0; stop < int(apart.size()); ++stop)
        if ((apart[stop] > 0.0) != is_in(closed, stop) &&
            (worst < 0 || std::abs(apart[stop]) > std::abs(apart[worst])))
          worst = stop;
      if (worst < 0) return true;
      toggle(closed, worst);
    }
    return false;
  }

  // The next change of a stop, or at the end of the period one of stop -1; nothing if the search takes too
  // long. Steps end before a stop can pass its gap, so that none is missed.
  std::optional<StopChange> next_change(const StopFlight& flight, const std::vector<int>& closed) const {
    constexpr int most = 200000;
    constexpr double shortest = 1e-13;
    const StopLooks looks(*flight.flow);
    double time = flight.begin;
    for (int n = 0; n < most; ++n) {
      const Eigen::ArrayXcd modal = flight.modal_at(time);
      const Eigen::ArrayXd sizes = modal.abs();
      double step = std::numeric_limits<double>::infinity();
      int first = -1;
      for (int stop = 0; stop < int(stops_.gap.size()); ++stop) {
        const double safe = looks.safe_step(stop, is_in(closed, stop), modal, sizes);
        if (safe < step) {
          step = safe;
          first = stop;
        }
      }
      if (!(step > shortest * waves_.period)) return StopChange{time, first};
      time += step;
      if (time >= waves_.period) return StopChange{waves_.period, -1};
    }
    return std::nullopt;
  }

  HeldFinder held_;
  const LinearStops& stops_;
  Waves waves_;
  std::map<std::vector<int>, LinearFlow> flows_;
  std::map<std::pair<const LinearFlow*, const LinearFlow*>, Eigen::MatrixXd> between_;
  Eigen::VectorXd state_, end_;  // at the origin and a period later, with the waves
  detail::Lu<double> fixed_;     // 1 - the last map
  std::vector<StopFlight> flights_;
};

// Phases are those at the origin, in periods.
Waves waves_from(const Eigen::MatrixXcd& linear_motion, const Eigen::VectorXd& gap, double origin,
                 double period) {
  Waves waves{{0.0}, linear_motion.col(0).real() - gap, period};
  for (Index n = 1; n < linear_motion.cols(); ++n) {
    if (linear_motion.col(n).isZero(0.0)) continue;
    waves.orders.push_back(double(n));
    waves.amplitudes.conservativeResize(Eigen::NoChange, waves.amplitudes.cols() + 1);
    waves.amplitudes.rightCols(1) =
        std::polar(1.0, 2.0 * std::numbers::pi * double(n) * origin) * linear_motion.col(n);
  }
  return waves;
}

}  // namespace

StopMotions::StopMotions(const ContactDynamics& dynamics, LinearStops stops)
    : dynamics_(dynamics), stops_(std::move(stops)) {}

std::optional<StopMotions> StopMotions::of(const CondensedProblem& problem, const ContactLaws& laws,
                                           const ContactDynamics& dynamics, const StabilityOptions& options) {
  const bool known = !dynamics.reduced() && !dynamics.structurally_damped() && dynamics.holding() == 0.0 &&
                     2 * int(dynamics.poles().size()) <= options.max_states;
  if (!known || laws.follow_frequency() || problem.structure().turns()) return std::nullopt;
  auto stops = detail::linear_stops(laws, problem.contacts());
  if (!stops) return std::nullopt;
  return StopMotions(dynamics, *std::move(stops));
}

bool StopMotions::are_needed(const PeriodicStiffness& stiffness, double frequency,
                             const StabilityOptions& options) const {
  return stiffness.status == StabilityStatus::converged &&
         !has_undamped_pole(dynamics_, 2.0 * std::numbers::pi * frequency) &&
         !harmonics_resolve(dynamics_, stiffness, frequency, options.harmonics, options.max_omitted);
}

// The modes of the stops that are closed, kept while the same poles are slow.
StopMotions::Reduced& StopMotions::reduced(double modulus) {
  constexpr std::size_t most_kept = 64, most_reduced = 8;
  const auto slow = std::size_t(std::ranges::count_if(
      dynamics_.poles(), [&](const ContactPole& pole) { return std::abs(pole.exponent) <= modulus; }));
  if (reduced_.size() > most_reduced) reduced_.clear();
  const auto at = reduced_.try_emplace(slow, Reduced{dynamics_.with_springs_beyond(modulus), {}}).first;
  if (at->second.held.size() > most_kept) at->second.held.clear();
  return at->second;
}

std::optional<Eigen::MatrixXd> StopMotions::map_beside(Reduced& reduced, const CondensedProblem& problem,
                                                       const PeriodicResponse& response,
                                                       const PeriodicStiffness& stiffness) {
  constexpr double farthest = 0.1;  // of motions of one kind
  const auto held = [&](const std::vector<int>& closed) -> const HeldByStops* {
    auto at = reduced.held.find(closed);
    if (at == reduced.held.end())
      at = reduced.held.emplace(closed, HeldByStops::of(reduced.dynamics, stops_, closed)).first;
    return at->second ? &*at->second : nullptr;
  };
  const double origin = quiet_instant(stiffness.intervals), period = 1.0 / response.frequency;
  StopSearch search(
      held, stops_,
      waves_from(free_->at(problem.frequency(), problem.load_factor()), stops_.gap, origin, period));
  std::optional<Eigen::MatrixXd> map = search.near(pattern_of(stiffness.intervals, origin, period));
  if (!map) return std::nullopt;
  const Eigen::MatrixXd displacement = response.displacement.reshaped(problem.points(), problem.contacts());
  constexpr Index samples = 128;  // of which a distance needs no more
  const Index stride = std::max<Index>(1, displacement.rows() / samples);
  double apart = 0.0, size = 0.0;
  for (Index l = 0; l < displacement.rows(); l += stride) {
    const double after = problem.pair().first_sample() + double(l) / double(displacement.rows()) - origin;
    const Eigen::VectorXd exact = search.apart(period * (after - std::floor(after))) + stops_.gap;
    apart += (exact - displacement.row(l).transpose()).squaredNorm();
    size += exact.squaredNorm();
  }
  return apart <= farthest * farthest * size ? map : std::nullopt;
}

std::optional<Eigen::VectorXcd> StopMotions::multipliers_beside(const CondensedProblem& problem,
                                                                const PeriodicResponse& response,
                                                                const PeriodicStiffness& stiffness,
                                                                const StabilityOptions& options) {
  if (!free_) free_.emplace(problem.structure(), problem.load_harmonics(), 0.0);
  const double highest = 2.0 * std::numbers::pi * response.frequency * options.harmonics;
  std::optional<Eigen::VectorXcd> before = Eigen::VectorXcd();
  for (double within = 1.0;; within *= 2.0) {
    if (!fast_modes_decay(dynamics_, within * highest, response.frequency)) continue;
    Reduced& slow = reduced(within * highest);
    const bool complete = slow.dynamics.poles().size() == dynamics_.poles().size();
    const auto map = map_beside(slow, problem, response, stiffness);
    std::optional<Eigen::VectorXcd> found;
    if (map) found = detail::map_multipliers(*map);
    const bool decided = found && before && before->size() > 0 && are_decided(*found, *before);
    if (complete || decided || !(found || before)) return found;
    before = std::move(found);
  }
}

}  // namespace wavebalance::solvers
