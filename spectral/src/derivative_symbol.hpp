#pragma once
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace wavebalance::spectral {

/// (2 pi i harmonic)^derivative with an exact power of i; derivative >= 0.
inline std::complex<double> derivative_symbol(int harmonic, int derivative) {
  constexpr std::array<std::complex<double>, 4> powers_of_i{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const double magnitude = std::pow(2.0 * std::numbers::pi * harmonic, derivative);
  return powers_of_i[static_cast<std::size_t>(derivative % 4)] * magnitude;
}

}  // namespace wavebalance::spectral
