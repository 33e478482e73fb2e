#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace wavebalance::contact::detail {

/// The number with 17 digits.
std::string text(double value);

/// Throws std::invalid_argument "<where>: <argument> is <value>; it must be <allowed>".
[[noreturn]] void reject(const std::string& where, const std::string& argument, double value,
                         const std::string& allowed);

void require_positive(const char* where, const char* argument, double value);
void require_finite(const char* where, const char* argument, double value);

enum class Bound { open, closed };
/// Finite, and above `least` (open) or not below it (closed).
void require_at_least(const char* where, const char* argument, double value, double least, Bound bound);

/// Throws std::invalid_argument "<where>: <array> has <length> entries; it must have <expected>" for another
/// length than that expected.
void require_length(const char* where, const char* array, std::size_t length, std::size_t expected);

/// Forces and tangents of a law at each displacement, arrays of one length.
template <class Law>
void evaluate_each(const Law& law, const char* where, std::span<const double> displacement,
                   std::span<double> force, std::span<double> tangent) {
  require_length(where, "force", force.size(), displacement.size());
  require_length(where, "tangent", tangent.size(), displacement.size());
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    const auto at = law.evaluate(displacement[i]);
    force[i] = at.force;
    tangent[i] = at.tangent;
  }
}

/// The larger of the two; not a number if one of them is not.
inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// The value, or the largest double where the value overflowed. Not a number stays not a number.
inline double saturate(double value) {
  constexpr double largest = std::numeric_limits<double>::max();
  return value > largest ? largest : value;
}

/// The same on both sides, for forces of either sign.
inline double saturate_both(double value) { return value < 0.0 ? -saturate(-value) : saturate(value); }

/// Energy of a spring at a penetration; 0 without one.
inline double spring_energy(double stiffness, double penetration) {
  return penetration <= 0.0 ? 0.0 : saturate(0.5 * (stiffness * penetration * penetration));
}

}  // namespace wavebalance::contact::detail
