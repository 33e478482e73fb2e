#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "wavebalance/solvers/time/time_basis.hpp"

namespace wavebalance::solvers::testing {

/// Two bases of a user: they meet the concept TimeBasis and use nothing of the wavelets module.

/// \int_0^1 of a B-spline of `order` pieces of width 1/M times exp(-2 pi i n t).
inline std::complex<double> spline_coefficient(int functions, int order, int harmonic) {
  const double x = std::numbers::pi * harmonic / functions;
  const double sinc = harmonic == 0 ? 1.0 : std::sin(x) / x;
  return std::pow(sinc, order) * std::polar(1.0 / functions, -order * x);
}

/// g = 1 on [0, 1/M), left-closed.
struct HaarBasis {
  int count = 8;

  int functions() const { return count; }
  Eigen::VectorXd samples(int points, int) const {
    Eigen::VectorXd g(points);
    for (int l = 0; l < points; ++l) g[l] = static_cast<long>(l) * count < points ? 1.0 : 0.0;
    return g;
  }
  std::complex<double> fourier_coefficient(int n) const { return spline_coefficient(count, 1, n); }
  double sobolev_exponent() const { return 0.5; }
  int pointwise_derivatives() const { return 0; }
  bool band_limited() const { return false; }
};

/// g(t) = sum_l B(M (t - l)) with the cubic B-spline B on [0, 4].
struct CubicBasis {
  int count = 8;

  int functions() const { return count; }
  Eigen::VectorXd samples(int points, int derivative) const {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(points);
    for (int l = 0; l < points; ++l)
      for (double x = double(l) * count / points; x < 4.0; x += count)
        g[l] += piece(x, derivative) * std::pow(double(count), derivative);
    return g;
  }
  std::complex<double> fourier_coefficient(int n) const { return spline_coefficient(count, 4, n); }
  double sobolev_exponent() const { return 3.5; }
  int pointwise_derivatives() const { return 2; }
  bool band_limited() const { return false; }

  // sum_k (-1)^k binomial(4, k) (x - k)_+^(3 - derivative) / (3 - derivative)!
  static double piece(double x, int derivative) {
    constexpr double binomial[] = {1.0, -4.0, 6.0, -4.0, 1.0};
    const int degree = 3 - derivative;
    double sum = 0.0;
    for (int k = 0; k <= 4; ++k) sum += binomial[k] * std::pow(std::max(x - k, 0.0), degree);
    return sum / std::tgamma(degree + 1.0);
  }
};

static_assert(TimeBasis<HaarBasis> && TimeBasis<CubicBasis>);

}  // namespace wavebalance::solvers::testing
