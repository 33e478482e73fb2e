#pragma once
#include <cmath>
#include <complex>

namespace wavebalance::solvers::detail {

/// 1 - exp(z) without cancellation.
inline std::complex<double> one_less_exp(std::complex<double> z) {
  const double half = std::sin(0.5 * z.imag());
  return {-std::expm1(z.real()) * std::cos(z.imag()) + 2.0 * half * half,
          -std::exp(z.real()) * std::sin(z.imag())};
}

}  // namespace wavebalance::solvers::detail
