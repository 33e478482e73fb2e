#pragma once
#include <functional>
#include <optional>

namespace wavebalance::solvers::detail {

/// A value of a function.
struct Sample {
  double at, value;
};

/// A zero between two places at which a function has different signs, to `tolerance` of their distance or
/// to rounding, by Brent's method (GSL). Nothing where the signs are the same or a value is not finite.
/// Exceptions of the function are passed on.
std::optional<double> root(const std::function<double(double)>& function, Sample a, Sample b,
                           double tolerance);

}  // namespace wavebalance::solvers::detail
