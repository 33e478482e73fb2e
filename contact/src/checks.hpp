#pragma once
#include <cstddef>
#include <limits>

namespace wavebalance::contact {

/// Throws std::invalid_argument naming the law, the argument, its value and what is allowed.
void require_positive(const char* law, const char* argument, double value);
void require_finite(const char* law, const char* argument, double value);
void require_equal_lengths(const char* law, std::size_t displacement, std::size_t force, std::size_t tangent);

/// The value, or the largest double where it overflowed; not a number stays not a number.
inline double saturate(double value) {
  constexpr double largest = std::numeric_limits<double>::max();
  return value > largest ? largest : value;
}

}  // namespace wavebalance::contact
