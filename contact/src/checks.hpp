#pragma once
#include <cmath>
#include <cstddef>
#include <limits>

namespace wavebalance::contact {

/// Throws std::invalid_argument naming the law, the argument, its value and what is allowed.
void require_positive(const char* law, const char* argument, double value);
void require_finite(const char* law, const char* argument, double value);
void require_equal_lengths(const char* law, std::size_t displacement, std::size_t force, std::size_t tangent);

enum class Bound { open, closed };
/// Finite, and above the bound (open) or not below it (closed).
void require_at_least(const char* law, const char* argument, double value, double least, Bound bound);

/// Throws std::invalid_argument naming the function and the array, unless its length is that expected.
void require_length(const char* function, const char* array, std::size_t length, std::size_t expected);

/// The larger of the two; not a number as soon as one is.
inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// The value, or the largest double where it overflowed; not a number stays not a number.
inline double saturate(double value) {
  constexpr double largest = std::numeric_limits<double>::max();
  return value > largest ? largest : value;
}

}  // namespace wavebalance::contact
