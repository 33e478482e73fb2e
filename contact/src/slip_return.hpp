#pragma once
#include <array>
#include <cmath>

namespace wavebalance::contact::detail {

/// A value with its derivatives by six variables.
struct Dual {
  double value = 0.0;
  std::array<double, 6> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: constants are meant to convert
  static Dual variable(double value, std::size_t index) {
    Dual result(value);
    result.slope[index] = 1.0;
    return result;
  }
  // g(this), g' = `by_value`.
  Dual through(double new_value, double by_value) const {
    Dual result(new_value);
    for (std::size_t i = 0; i < slope.size(); ++i) result.slope[i] = by_value * slope[i];
    return result;
  }
  // g(one, other) with its two partial derivatives.
  static Dual of(double value, const Dual& one, double by_one, const Dual& other, double by_other) {
    Dual result(value);
    for (std::size_t i = 0; i < result.slope.size(); ++i)
      result.slope[i] = by_one * one.slope[i] + by_other * other.slope[i];
    return result;
  }
  friend Dual operator+(const Dual& a, const Dual& b) { return of(a.value + b.value, a, 1.0, b, 1.0); }
  friend Dual operator-(const Dual& a, const Dual& b) { return of(a.value - b.value, a, 1.0, b, -1.0); }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return of(a.value * b.value, a, b.value, b, a.value);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return of(a.value / b.value, a, 1.0 / b.value, b, -a.value / (b.value * b.value));
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.through(root, 0.5 / root);
  }
  friend Dual exp(const Dual& a) {
    const double power = std::exp(a.value);
    return a.through(power, power);
  }
};
inline double value_of(double number) { return number; }
inline double value_of(const Dual& number) { return number.value; }

/// A force of two components at the end of a step and the mean limit while it slips.
template <class Number>
struct SlipEnd {
  std::array<Number, 2> force;
  Number mean_limit;
};

/// The share of a straight step `d` from the force f after which its norm reaches the limit, which goes from
/// `first` to `last`, for a force within the first limit and a trial force beyond the last one.
template <class Number>
Number share_in_stick(const std::array<Number, 2>& f, const std::array<Number, 2>& d, const Number& first,
                      const Number& last) {
  using std::sqrt;
  const Number rise = last - first;
  const Number a = d[0] * d[0] + d[1] * d[1] - rise * rise;
  const Number b = f[0] * d[0] + f[1] * d[1] - first * rise;
  const Number c = f[0] * f[0] + f[1] * f[1] - first * first;
  // From a force on the limit an outward step slips at once, an inward one after the chord.
  const double size = value_of(first) * value_of(first);
  if (value_of(c) >= -1e-13 * size) {
    if (value_of(b) >= 0.0 || value_of(a) <= 0.0) return Number(0.0);
    return Number(-2.0) * b / a;
  }
  const Number root = sqrt(b * b - a * c);
  return Number(-1.0) * c / (b + root);
}

/// The end of a step that slips, along a straight line and with the limit in proportion: the force turns
/// towards the direction of the step as tan(psi / 2) falls like exp(-s / limit) over the distance s, psi the
/// angle between them. `d` is not zero, `last` is positive.
template <class Number>
SlipEnd<Number> slip_return(const std::array<Number, 2>& f, const std::array<Number, 2>& d,
                            const Number& first, const Number& last) {
  using std::exp;
  using std::sqrt;
  const Number stick = share_in_stick(f, d, first, last);
  const Number length = sqrt(d[0] * d[0] + d[1] * d[1]);
  const std::array<Number, 2> along{d[0] / length, d[1] / length};
  const std::array<Number, 2> at{f[0] + stick * d[0], f[1] + stick * d[1]};
  const Number mean = (first + stick * (last - first) + last) * Number(0.5);
  const Number cosine = at[0] * along[0] + at[1] * along[1], sine = along[0] * at[1] - along[1] * at[0];
  const Number norm2 = cosine * cosine + sine * sine;
  if (!(value_of(norm2) > 0.0)) return {{last * along[0], last * along[1]}, mean};
  const Number whole = sqrt(norm2) + cosine;
  if (!(value_of(whole) > 1e-14 * std::sqrt(value_of(norm2))))
    return {{last * (Number(0.0) - along[0]), last * (Number(0.0) - along[1])}, mean};
  const Number half = sine / whole * exp(Number(0.0) - (Number(1.0) - stick) * length / mean);
  const Number square = half * half, total = Number(1.0) + square;
  const Number c = (Number(1.0) - square) / total, s = Number(2.0) * half / total;
  return {{last * (c * along[0] - s * along[1]), last * (c * along[1] + s * along[0])}, mean};
}

}  // namespace wavebalance::contact::detail
