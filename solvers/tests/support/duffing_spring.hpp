#pragma once
#include <limits>

namespace wavebalance::solvers::testing {

/// A spring that acts everywhere, of the force linear u + cubic u^3 at a displacement u.
struct DuffingSpring {
  double cubic = 1.0, linear = 0.0;
  double start = std::numeric_limits<double>::infinity();  ///< its declared gap

  double force(double u) const { return u * (linear + cubic * u * u); }
  double tangent(double u) const { return linear + 3.0 * cubic * u * u; }
  double potential(double u) const { return u * u * (0.5 * linear + 0.25 * cubic * u * u); }
  double gap() const { return start; }
  bool unilateral() const { return false; }
};

}  // namespace wavebalance::solvers::testing
