#include "pivot_recursion.hpp"

#include <cmath>

namespace wavebalance::solvers {

PivotRecursion::PivotRecursion(const StiffnessSpectrum& factors, const StiffnessSpectrum& rates) {
  for (std::size_t d = 0; d < 3; ++d) {
    factors_[d] = {factors[d].real(), factors[d].imag()};
    rates_[d] = {rates[d].real(), rates[d].imag()};
    magnitudes_[d] = factors_[d].re.abs() + factors_[d].im.abs();
  }
}

PivotRecursion::Parts PivotRecursion::combine(const std::array<Parts, 3>& spectrum,
                                              const std::array<double, 3>& entries) {
  return {spectrum[0].re * entries[0] + spectrum[1].re * entries[1] + spectrum[2].re * entries[2],
          spectrum[0].im * entries[0] + spectrum[1].im * entries[1] + spectrum[2].im * entries[2]};
}

void PivotRecursion::eliminate(const Row& row) {
  Parts pivot = combine(factors_, row.diagonal);
  Parts rate = combine(rates_, row.diagonal);
  // The size of the terms, not of their sum: at a natural frequency of an undamped structure they cancel.
  const Eigen::ArrayXd scale = magnitudes_[0] * std::abs(row.diagonal[0]) +
                               magnitudes_[1] * std::abs(row.diagonal[1]) +
                               magnitudes_[2] * std::abs(row.diagonal[2]);
  if (!first_) {
    const Parts off = combine(factors_, row.off);
    const Parts off_rate = combine(rates_, row.off);
    // w = off / d, so that d_i = z_ii - off w and d_i' = z_ii' - 2 off' w - off^2 (1/d)'.
    const Parts w{off.re * inverse_.re - off.im * inverse_.im, off.re * inverse_.im + off.im * inverse_.re};
    const Parts square{off.re * off.re - off.im * off.im, 2.0 * off.re * off.im};
    pivot.re -= off.re * w.re - off.im * w.im;
    pivot.im -= off.re * w.im + off.im * w.re;
    rate.re -=
        2.0 * (off_rate.re * w.re - off_rate.im * w.im) + square.re * slope_.re - square.im * slope_.im;
    rate.im -=
        2.0 * (off_rate.re * w.im + off_rate.im * w.re) + square.re * slope_.im + square.im * slope_.re;
  }
  const Eigen::ArrayXd norm = pivot.re.square() + pivot.im.square();
  weak_ = weak_ || !(norm > (weak_pivot * weak_pivot) * scale.square()).all();
  inverse_ = {pivot.re / norm, -pivot.im / norm};
  // (1/d)' = -d' / d^2
  const Parts square{inverse_.re.square() - inverse_.im.square(), 2.0 * inverse_.re * inverse_.im};
  slope_ = {rate.im * square.im - rate.re * square.re, -(rate.re * square.im + rate.im * square.re)};
  first_ = false;
}

void PivotRecursion::last(Eigen::Ref<Eigen::VectorXcd> inverse, Eigen::Ref<Eigen::VectorXcd> slope) const {
  inverse.real() = inverse_.re;
  inverse.imag() = inverse_.im;
  slope.real() = slope_.re;
  slope.imag() = slope_.im;
}

}  // namespace wavebalance::solvers
