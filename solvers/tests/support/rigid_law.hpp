#pragma once

#include <limits>

#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::solvers::testing {

// A rigid obstacle as a user writes it.
struct Rigid {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  double start;  // m
  double force(double u) const { return u > start ? infinity : 0.0; }
  double tangent(double u) const { return u >= start ? infinity : 0.0; }
  double potential(double u) const { return u > start ? infinity : 0.0; }
  double gap() const { return start; }
  ForceSlope resolvent(double v, double flexibility) const {
    return v < start ? ForceSlope{} : ForceSlope{(v - start) / flexibility, 1.0 / flexibility};
  }
};

}  // namespace wavebalance::solvers::testing
