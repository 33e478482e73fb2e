#pragma once
#include <array>
#include <cmath>

namespace wavebalance::solvers {

/// A value with its gradient by what a law reads at an instant: laws are written as formulas, their
/// derivatives are exact (forward differentiation).
struct Dual {
  static constexpr int capacity = 14;  ///< four signals of three rows and two memories

  double value = 0.0;
  std::array<double, capacity> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: a number is meant to convert
  /// The signal with this number.
  static Dual signal(double value, int number) {
    Dual result(value);
    result.slope[static_cast<std::size_t>(number)] = 1.0;
    return result;
  }

  Dual& add(const Dual& other, double factor) {
    value += factor * other.value;
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] += factor * other.slope[i];
    return *this;
  }
};

inline Dual operator*(double factor, const Dual& a) { return Dual().add(a, factor); }
inline Dual operator+(Dual a, const Dual& b) { return a.add(b, 1.0); }
inline Dual operator-(Dual a, const Dual& b) { return a.add(b, -1.0); }
inline Dual operator-(const Dual& a) { return -1.0 * a; }
inline Dual operator*(const Dual& a, const Dual& b) {
  return Dual(-a.value * b.value).add(a, b.value).add(b, a.value);
}
inline Dual operator/(const Dual& a, const Dual& b) {
  return Dual(a.value / b.value).add(a, 1.0 / b.value).add(b, -a.value / (b.value * b.value));
}

}  // namespace wavebalance::solvers
