#include "exact_bar_mode.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "checks.hpp"

namespace wavebalance::ll10 {
namespace {

double shortest_period(int mode) { return (2.0 * mode + 1.0) / (double(mode) * mode); }
double longest_period(int mode) { return 4.0 / (2.0 * mode - 1.0); }
double largest_excess(int mode) { return 1.0 / (double(mode) * mode * (2.0 * mode - 1.0)); }
double linear_omega(int mode) { return (2.0 * mode - 1.0) * std::numbers::pi / 2.0; }

void require_mode(int mode) {
  if (mode < 1) contact::detail::reject("ExactBarMode", "mode", mode, "at least 1");
}

// V over g0/L for a period T that exceeds the shortest one by `excess`.
double relative_amplitude(int mode, double excess) { return 1.0 / (2.0 * mode * mode * excess); }

// f' = +V over this length of each period, m T - 2.
double rising_length(int mode, double excess) { return 1.0 / mode + mode * excess; }

// The period mean of int_0^1 (f'(t + x) - f'(t - x))^2 / 2 dx in units of V^2; the total energy is 2.
double mean_kinetic(int mode, double excess) {
  const double rising = rising_length(mode, excess);
  const double period = shortest_period(mode) + excess;
  return rising * (2.0 * mode * period - (2.0 * mode + 1.0) * rising) / period;
}

// The energy over the energy of linear grazing, for V = amplitude * g0/L.
double energy_ratio_of(int mode, double excess, double amplitude, EnergyMeasure measure) {
  const double linear = linear_omega(mode);
  const double scaled = amplitude / linear;
  switch (measure) {
    case EnergyMeasure::total:
      return 8.0 * scaled * scaled;
    case EnergyMeasure::mean_kinetic:
      return 8.0 * mean_kinetic(mode, excess) * scaled * scaled;
    case EnergyMeasure::modal:
      break;
  }
  const double slowness = (shortest_period(mode) + excess) / longest_period(mode);
  return 8.0 * mean_kinetic(mode, excess) * (slowness * scaled) * (slowness * scaled);
}

double energy_ratio_at(int mode, double excess, EnergyMeasure measure) {
  return energy_ratio_of(mode, excess, relative_amplitude(mode, excess), measure);
}

// T - (2m+1)/m^2 for a frequency ratio. The fused operation keeps it exact but for the last rounding where
// the two nearly cancel.
double excess_of(int mode, double frequency_ratio) {
  const double m = mode;
  const double numerator = std::fma(-frequency_ratio, 4.0 * m * m - 1.0, 4.0 * m * m);
  return numerator / (frequency_ratio * m * m * (2.0 * m - 1.0));
}

[[noreturn]] void reject_energy(int mode, double energy_ratio, double onset) {
  contact::detail::reject(
      "ExactBarMode", "energy_ratio", energy_ratio,
      "above " + contact::detail::text(onset) + " and finite for mode " + std::to_string(mode));
}

double checked_excess(int mode, double frequency_ratio) {
  const double largest = ExactBarMode::largest_frequency_ratio(mode);
  const double excess = excess_of(mode, frequency_ratio);
  if (frequency_ratio > 1.0 && frequency_ratio < largest && excess > 0.0) return excess;
  contact::detail::reject(
      "ExactBarMode", "frequency_ratio", frequency_ratio,
      "above 1 and below " + contact::detail::text(largest) + " for mode " + std::to_string(mode));
}

}  // namespace

void RigidObstacleBar::validate() const {
  contact::detail::require_positive("RigidObstacleBar", "youngs_modulus", youngs_modulus);
  contact::detail::require_positive("RigidObstacleBar", "density", density);
  contact::detail::require_positive("RigidObstacleBar", "area", area);
  contact::detail::require_positive("RigidObstacleBar", "length", length);
  contact::detail::require_positive("RigidObstacleBar", "gap", gap);
}

double ExactBarMode::largest_frequency_ratio(int mode) {
  require_mode(mode);
  const double square = 4.0 * mode * mode;
  return square / (square - 1.0);
}

double ExactBarMode::linear_frequency(const RigidObstacleBar& bar, int mode) {
  require_mode(mode);
  bar.validate();
  return std::sqrt(bar.youngs_modulus / bar.density) / bar.length / longest_period(mode);
}

ExactBarMode::ExactBarMode(const RigidObstacleBar& bar, int mode, Excess excess, double amplitude)
    : bar_(bar),
      mode_(mode),
      excess_(excess.value),
      period_(shortest_period(mode) + excess.value),
      amplitude_(amplitude) {}

ExactBarMode::ExactBarMode(RigidObstacleBar bar, int mode, double frequency_ratio)
    : bar_(bar), mode_(mode), excess_(0.0), period_(0.0), amplitude_(0.0) {
  bar_.validate();
  excess_ = checked_excess(mode, frequency_ratio);
  period_ = shortest_period(mode) + excess_;
  amplitude_ = relative_amplitude(mode, excess_) * (bar_.gap / bar_.length);
}

ExactBarMode ExactBarMode::at_energy(RigidObstacleBar bar, int mode, EnergyMeasure measure,
                                     double energy_ratio) {
  bar.validate();
  const double onset = onset_energy(mode, measure);
  if (!(energy_ratio > onset && std::isfinite(energy_ratio))) reject_energy(mode, energy_ratio, onset);
  double low = 0.0, high = largest_excess(mode);
  for (double middle = 0.5 * high; middle > low && middle < high; middle = low + 0.5 * (high - low))
    (energy_ratio_at(mode, middle, measure) > energy_ratio ? low : high) = middle;
  const double excess = low > 0.0 ? low : high;
  return {bar, mode, Excess{excess}, relative_amplitude(mode, excess) * (bar.gap / bar.length)};
}

ExactBarMode ExactBarMode::zero_gap(RigidObstacleBar bar, int mode, double total_energy) {
  require_mode(mode);
  bar.gap = 1.0;  // not used, but it must be valid
  bar.validate();
  bar.gap = 0.0;
  contact::detail::require_positive("ExactBarMode::zero_gap", "total_energy", total_energy);
  const double stiffness = bar.youngs_modulus * bar.area * bar.length;
  return {bar, mode, Excess{0.0}, std::sqrt(0.5 * total_energy / stiffness)};
}

double ExactBarMode::onset_energy(int mode, EnergyMeasure measure) {
  require_mode(mode);
  return energy_ratio_at(mode, largest_excess(mode), measure);
}

double ExactBarMode::frequency_ratio() const { return longest_period(mode_) / period_; }

double ExactBarMode::period() const {
  return period_ * bar_.length / std::sqrt(bar_.youngs_modulus / bar_.density);
}

double ExactBarMode::frequency() const { return 1.0 / period(); }

double ExactBarMode::contact_duration() const {
  return (2.0 * mode_ - 1.0) * (largest_excess(mode_) - excess_) * (period() / period_);
}

double ExactBarMode::phase(double t) const { return std::remainder(t, period()) / period() * period_; }

double ExactBarMode::position(const char* quantity, double x) const {
  constexpr double slack = 1e-12;  // allows for rounding in an x that is a sum of element lengths
  const double position = x / bar_.length;
  if (position < -slack || position > 1.0 + slack)
    contact::detail::reject(std::string("ExactBarMode::") + quantity, "x", x,
                            "in [0, " + contact::detail::text(bar_.length) + "]");
  return std::isnan(position) ? position : std::clamp(position, 0.0, 1.0);
}

// The rising interval is centred on (m - 1) T/2, so that f' is even and the contact is around t = 0.
double ExactBarMode::sign(double s) const {
  const double half = 0.5 * rising_length(mode_, excess_);
  const double distance = std::abs(std::remainder(s - 0.5 * (mode_ - 1) * period_, period_));
  if (std::isnan(distance)) return distance;
  constexpr double front = 1e-14;
  if (std::abs(distance - half) <= front) return 0.0;
  return distance < half ? 1.0 : -1.0;
}

double ExactBarMode::primitive(double s) const {
  const double half = 0.5 * rising_length(mode_, excess_);
  const double shifted = s - 0.5 * (mode_ - 1) * period_;
  const double rest = std::remainder(shifted, period_);
  const double periods = std::round((shifted - rest) / period_);
  const double falling = std::copysign(1.0, rest) * (2.0 * half - std::abs(rest));
  const double inside = std::abs(rest) <= half ? rest : falling;
  return periods * (4.0 * half - period_) + inside;
}

double ExactBarMode::displacement(double x, double t) const {
  const double at = position("displacement", x);
  const double time = phase(t);
  return amplitude_ * bar_.length * (primitive(time + at) - primitive(time - at));
}

double ExactBarMode::velocity(double x, double t) const {
  const double at = position("velocity", x);
  const double time = phase(t);
  return amplitude_ * bar_.length * (sign(time + at) - sign(time - at)) * (period_ / period());
}

double ExactBarMode::strain(double x, double t) const {
  const double at = position("strain", x);
  const double time = phase(t);
  return amplitude_ * (sign(time + at) + sign(time - at));
}

double ExactBarMode::contact_force(double t) const {
  const double force = -bar_.youngs_modulus * bar_.area * strain(bar_.length, t);
  return force == 0.0 ? 0.0 : force;
}

double ExactBarMode::total_energy() const {
  return 2.0 * amplitude_ * amplitude_ * bar_.youngs_modulus * bar_.area * bar_.length;
}

double ExactBarMode::mean_kinetic_energy() const {
  return 0.5 * total_energy() * mean_kinetic(mode_, excess_);
}

double ExactBarMode::energy_ratio(EnergyMeasure measure) const {
  return energy_ratio_of(mode_, excess_, amplitude_ * bar_.length / bar_.gap, measure);
}

double ExactBarMode::rayleigh_frequency_ratio() const {
  const double kinetic = mean_kinetic(mode_, excess_);
  return frequency_ratio() * std::sqrt((2.0 - kinetic) / kinetic);
}

}  // namespace wavebalance::ll10
