#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "exact_bar_mode.hpp"

namespace wavebalance::ll10 {

/// The rod of [LL10, section 5.1] with a gap of a millimetre.
inline RigidObstacleBar published_bar() { return {2.1e11, 7800.0, 0.03 * 0.03, 1.0, 1e-3}; }

/// The mode at a fraction in (0, 1) of its interval of frequencies.
inline ExactBarMode mode_at(const RigidObstacleBar& bar, int mode, double fraction) {
  return {bar, mode, 1.0 + fraction * (ExactBarMode::largest_frequency_ratio(mode) - 1.0)};
}

/// Places in the interval of frequencies of a mode.
inline constexpr double fractions[] = {0.02, 0.3, 0.7, 0.98};

/// Modes of two bars over their intervals of frequencies.
template <class Check>
void for_each_mode(const Check& check) {
  for (const RigidObstacleBar& bar : {RigidObstacleBar{}, published_bar()})
    for (int m = 1; m <= 4; ++m)
      for (double fraction : fractions) {
        SCOPED_TRACE("mode " + std::to_string(m) + " at " + std::to_string(fraction));
        check(mode_at(bar, m, fraction));
      }
}

/// The largest displacement that the motion can reach, V times the length of a rise of f: its scale of
/// rounding.
inline double reach(const ExactBarMode& mode) {
  const RigidObstacleBar& bar = mode.bar();
  return 2.0 * bar.length * mode.contact_force(0.0) / (bar.youngs_modulus * bar.area);
}

/// Integral over (a, b) of a function with finitely many values: intervals whose ends and middle differ are
/// halved down to a width of 1e-13.
inline double step_integral(const std::function<double(double)>& step, double a, double b) {
  const double left = step(a), right = step(b), middle = step(0.5 * (a + b));
  if (left == right && left == middle) return left * (b - a);
  if (b - a < 1e-13) return middle * (b - a);
  return step_integral(step, a, 0.5 * (a + b)) + step_integral(step, 0.5 * (a + b), b);
}

/// The same on `panels` equal parts, each narrower than the distance of two jumps.
inline double step_integral(const std::function<double(double)>& step, double a, double b, int panels) {
  double sum = 0.0;
  for (int i = 0; i < panels; ++i)
    sum += step_integral(step, a + (b - a) * i / panels, a + (b - a) * (i + 1) / panels);
  return sum;
}

inline double kinetic_energy(const ExactBarMode& mode, double t, int panels = 64) {
  const RigidObstacleBar& bar = mode.bar();
  return step_integral(
      [&](double x) {
        const double v = mode.velocity(x, t);
        return 0.5 * bar.density * bar.area * v * v;
      },
      0.0, bar.length, panels);
}

inline double elastic_energy(const ExactBarMode& mode, double t) {
  const RigidObstacleBar& bar = mode.bar();
  return step_integral(
      [&](double x) {
        const double strain = mode.strain(x, t);
        return 0.5 * bar.youngs_modulus * bar.area * strain * strain;
      },
      0.0, bar.length, 64);
}

/// The bar of unit length and wave speed, advanced by its characteristics on a lattice, contact decided by
/// the state at the tip: exact as long as all fronts start on the lattice. Knows nothing of modes.
class CharacteristicBar {
 public:
  /// right, left: u_t - u_x and u_t + u_x in cells of width 1/right.size(); tip: its displacement.
  CharacteristicBar(std::vector<double> right, std::vector<double> left, double tip, double gap)
      : right_(std::move(right)), left_(std::move(left)), tip_(tip), gap_(gap) {}

  void step() {
    const double incoming = right_.back(), width = 1.0 / static_cast<double>(right_.size());
    force_ = tip_ >= gap_ - 1e-9 && incoming > 0.0 ? incoming : 0.0;
    const double reflected = force_ > 0.0 ? -incoming : incoming;
    if (force_ == 0.0) tip_ += incoming * width;
    const double returned = -left_.front();
    right_.pop_back();
    right_.insert(right_.begin(), returned);
    left_.erase(left_.begin());
    left_.push_back(reflected);
  }

  double velocity(int cell) const { return 0.5 * (right_[cell] + left_[cell]); }
  double strain(int cell) const { return 0.5 * (left_[cell] - right_[cell]); }
  double tip() const { return tip_; }
  double force() const { return force_; }  ///< over the last step, E A = 1

 private:
  std::vector<double> right_, left_;
  double tip_, gap_, force_ = 0.0;
};

}  // namespace wavebalance::ll10
