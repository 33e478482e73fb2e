#pragma once
#include <Eigen/Core>
#include <complex>

#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::wavelets {

/// The M = 2^J translates g(t - j/M) on the circle [0, 1) of the periodized generator
///     g(t) = sum_{l in Z} phi(M (t - l))                                             [JL14, eq. (25)]
/// of a scaling function, at any level J >= 0, also where the support wraps round the circle several times.
/// Unscaled: the translates sum to 1, each has integral 1/M, and <g(. - i/M), g(. - j/M)> = delta_ij / M.
/// JL14's figures 3-5 draw M g, of integral 1; the orthonormal basis is sqrt(M) g(. - j/M). Immutable; may be
/// shared between threads.
class PeriodicBasis {
 public:
  /// Throws std::invalid_argument unless 0 <= level <= 24.
  PeriodicBasis(ScalingFunction scaling_function, int level);

  const ScalingFunction& scaling_function() const { return scaling_function_; }
  int level() const { return level_; }
  /// M = 2^level.
  int functions() const { return 1 << level_; }

  /// d^derivative g / dt^derivative at t = l/points, l = 0..points-1. Haar and B-spline accept any points >=
  /// 1, the Daubechies functions of four coefficients and more any power of two (dyadic points). Cost O(L
  /// (support + 1) max(points / M, 1) + points). Throws std::invalid_argument for other points, and for a
  /// derivative outside 0..pointwise_derivatives().
  Eigen::VectorXd samples(int points, int derivative = 0) const;

  /// The integral of g(t) exp(-2 pi i harmonic t) over the period, phi^(2 pi harmonic / M) / M. Cost O(L)
  /// times some 60 factors for Daubechies, O(1) for the splines.
  std::complex<double> fourier_coefficient(int harmonic) const;

  double sobolev_exponent() const { return scaling_function_.sobolev_exponent(); }
  int pointwise_derivatives() const { return scaling_function_.pointwise_derivatives(); }
  bool band_limited() const { return false; }

 private:
  Eigen::VectorXd spline_samples(int points, int derivative) const;
  Eigen::VectorXd dyadic_samples(int points, int derivative) const;

  ScalingFunction scaling_function_;
  int level_;
};

}  // namespace wavebalance::wavelets
