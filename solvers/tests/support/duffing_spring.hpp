#pragma once
#include <limits>

namespace wavebalance::solvers::testing {

/// The spring of a Duffing oscillator beside its linear one: u^3 N for a displacement of u m.
struct DuffingSpring {
  double force(double u) const { return u * u * u; }
  double tangent(double u) const { return 3.0 * u * u; }
  double potential(double u) const { return 0.25 * u * u * u * u; }
  double gap() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace wavebalance::solvers::testing
