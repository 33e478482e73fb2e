#include "modes/elastic_backbone.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modes/elastic_point.hpp"

namespace wavebalance::solvers {
namespace {

// Amplitude over that at grazing at which a curve without a linear branch starts: an energy ratio of 1e-4.
constexpr double first_amplitude = 0.01;
// Beyond an internal resonance the energy is at most this multiple of the largest before; else it belongs
// to another curve.
constexpr double most_energy_jump = 2.0;

}  // namespace

bool ModeFollower::start() {
  state_ = curve_.linear_state(starts_linear_ ? 1.0 : first_amplitude);
  if (!starts_linear_) {
    if (!curve_.project_onto_curve(state_)) return false;
    result_.points.push_back(measure(state_.iterations));
    energy_ = result_.points.back().energy_ratio;
  }
  before_ = state_;
  before_energy_ = largest_energy_ = energy_;
  recent_.push_back({state_, energy_});
  highest_ = curve_.frequency(state_);
  return true;
}

ModePoint ModeFollower::measure(int iterations) const {
  return elastic_point(curve_.equations(), iterations);
}

// Beyond an internal resonance the curve goes on, at energies that no motion off the resonance may have. The
// frequency must exceed all before, so that nothing is passed twice.
bool ModeFollower::pass_resonance() {
  double frequency = curve_.frequency(state_);
  if (!result_.points.empty() && result_.points.back().status == ModeStatus::internal_resonance) {
    const InternalResonance& resonance = result_.points.back().resonance;
    const ModeProblem& problem = curve_.equations().problem();
    frequency = std::sqrt(problem.model.omega_squared[resonance.mode - 1] /
                          problem.transform.inertia[resonance.harmonic]) /
                problem.omega();
  }
  for (auto base = recent_.rbegin(); base != recent_.rend(); ++base)
    if (leap_over(std::max(frequency, highest_), *base)) return true;
  return bridge(std::max(frequency, highest_));
}

bool ModeFollower::is_near(const ModePoint& point) const {
  return point.energy_ratio <= most_energy_jump * largest_energy_;
}

// A longer step from a point before the resonance.
bool ModeFollower::leap_over(double frequency, const Accepted& base) {
  CurveState beyond = base.state;
  const auto accepts = [&] {
    const ModePoint point = measure(0);
    return point.status == ModeStatus::converged && point.energy_ratio > base.energy && is_near(point) &&
           point.omega > frequency * curve_.equations().problem().omega();
  };
  if (!curve_.leap(beyond, accepts)) return false;
  before_ = base.state;
  before_energy_ = base.energy;
  state_ = std::move(beyond);
  return true;
}

// The curve of motions with few harmonics has few resonances. It is followed from grazing to a frequency
// beyond `frequency`, where one harmonic after the other is added [as NonlinearMode does].
bool ModeFollower::bridge(double frequency) {
  constexpr double distances[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05};
  constexpr int few_harmonics = 2, max_steps = 400;
  if (!starts_linear_) return false;
  ModeEquations& equations = curve_.equations();
  const int all = equations.highest();
  CurveState low = curve_.linear_state(1.0);
  int steps = 0;
  for (const double distance : distances) {
    equations.set_highest(std::min(few_harmonics, all));
    const double target = frequency * (1.0 + distance);
    while (curve_.frequency(low) < target && steps < max_steps && curve_.advance(low)) ++steps;
    if (curve_.frequency(low) < target) break;
    CurveState high = low;
    const bool found = raise_harmonics(high, target, all);
    equations.set_highest(all);
    if (!found) continue;
    const ModePoint point = measure(high.iterations);
    if (point.status != ModeStatus::converged || !is_near(point)) continue;
    state_ = before_ = std::move(high);
    recent_.clear();
    before_energy_ = point.energy_ratio;
    bridged_ = true;
    curve_.restart();
    return true;
  }
  equations.set_highest(all);
  return false;
}

bool ModeFollower::raise_harmonics(CurveState& state, double frequency, int all) {
  ModeEquations& equations = curve_.equations();
  int spent = 0;
  for (int highest = equations.highest(); highest <= all; ++highest) {
    equations.set_highest(highest);
    if (!curve_.project_onto_curve_at(frequency, 1.0, state)) return false;
    spent += state.iterations;
  }
  state.iterations = spent;
  return true;
}

void ModeFollower::keep(ModePoint point) {
  constexpr std::size_t most = 10;
  energy_ = point.energy_ratio;
  largest_energy_ = std::max(largest_energy_, energy_);
  highest_ = std::max(highest_, curve_.frequency(state_));
  recent_.push_back({state_, energy_});
  if (recent_.size() > most) recent_.pop_front();
  result_.points.push_back(std::move(point));
}

std::optional<BackboneStatus> ModeFollower::end_at(const ModePoint& point) const {
  if (point.energy_ratio > options_.max_energy) return BackboneStatus::reached_energy;
  const double ratio = point.omega / curve_.equations().problem().linear_omega();
  if (ratio > options_.max_frequency_ratio) return BackboneStatus::reached_frequency;
  return std::nullopt;
}

std::optional<BackboneStatus> ModeFollower::step() {
  const CurveState last = state_;
  bridged_ = false;
  if (!curve_.advance(state_)) {
    if (on_resonance_) return BackboneStatus::internal_resonance;
    if (!pass_resonance()) return result_.points.empty() ? BackboneStatus::no_start : BackboneStatus::lost;
  } else {
    before_ = last;
    before_energy_ = energy_;
  }
  ModePoint point = measure(state_.iterations);
  if (point.status != ModeStatus::internal_resonance) {
    on_resonance_ = false;
  } else if (!on_resonance_) {
    const CurveState here = state_;
    result_.points.push_back(point);
    if (pass_resonance()) {
      point = measure(state_.iterations);
    } else {
      // No motion lies beyond: the curve itself goes on along the resonance.
      on_resonance_ = true;
      result_.points.pop_back();
      state_ = here;
      curve_.restart();
    }
  }
  const auto end = end_at(point);
  keep(std::move(point));
  return end;
}

ElasticBackbone ModeFollower::follow() {
  if (!start()) return std::move(result_);
  for (;;) {
    const auto count = static_cast<int>(result_.points.size());
    const double reached = count == 0 ? 0.0 : result_.points.back().energy_ratio;
    const double done = std::log(std::max(reached, 1.0)) / std::log(options_.max_energy);
    if (count >= options_.max_points) {
      result_.status = BackboneStatus::point_limit;
    } else if (!goes_on(options_.observer, {"backbone", count, reached, "energy ratio", done})) {
      result_.status = BackboneStatus::cancelled;
    } else if (const auto end = step()) {
      result_.status = *end;
    } else {
      continue;
    }
    return result_;
  }
}

// Secant steps from the last point below the energy, halved where Newton's method fails.
ModePoint ModeFollower::at_energy(double energy_ratio, double tolerance) {
  constexpr int max_steps = 100;
  ModePoint point = result_.points.back();
  CurveState base = before_, next;
  double base_energy = before_energy_, step = curve_.last_step();
  for (int i = 0; i < max_steps && !bridged_; ++i) {
    if (!curve_.correct(base, step, next)) {
      step *= 0.5;
      continue;
    }
    point = measure(next.iterations);
    if (std::abs(point.energy_ratio / energy_ratio - 1.0) <= tolerance) return point;
    if (point.energy_ratio < energy_ratio) {
      std::swap(base, next);
      base_energy = point.energy_ratio;
    } else {
      step *= (energy_ratio - base_energy) / (point.energy_ratio - base_energy);
    }
  }
  point.status = ModeStatus::internal_resonance;  // no motion off the resonance was found with this energy
  return point;
}

}  // namespace wavebalance::solvers
