#include "wavebalance/spectral/fourier_basis.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

#include "require.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::spectral {
namespace {

// (2 pi i harmonic)^derivative with an exact power of i.
std::complex<double> derivative_symbol(int harmonic, int derivative) {
  constexpr std::array<std::complex<double>, 4> powers_of_i{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const double magnitude = std::pow(2.0 * std::numbers::pi * harmonic, derivative);
  return powers_of_i[static_cast<std::size_t>(derivative % 4)] * magnitude;
}

void require_representable(int functions, int derivative) {
  const double most = 300.0 / std::log10(std::numbers::pi * functions + 1.0);
  if (derivative < most) return;
  throw std::invalid_argument("FourierBasis::samples: derivative is " + std::to_string(derivative) +
                              "; it must be below " + std::to_string(most) + " with " +
                              std::to_string(functions) + " functions, so that its values fit a double");
}

}  // namespace

FourierBasis::FourierBasis(int functions, Nyquist nyquist) : functions_(functions), nyquist_(nyquist) {
  detail::require_at_least("FourierBasis: functions", functions, 1);
}

std::complex<double> FourierBasis::fourier_coefficient(int harmonic) const {
  const double weight = 1.0 / functions_;
  const long long twice = 2LL * std::abs(static_cast<long long>(harmonic));
  if (twice < functions_) return weight;
  if (twice > functions_) return 0.0;
  if (nyquist_ == Nyquist::cosine) return 0.5 * weight;
  return {0.0, harmonic > 0 ? -0.5 * weight : 0.5 * weight};
}

Eigen::VectorXd FourierBasis::samples(int points, int derivative) const {
  detail::require_at_least("FourierBasis::samples: points", points, 1);
  detail::require_at_least("FourierBasis::samples: derivative", derivative, 0);
  require_representable(functions_, derivative);
  // Harmonics that differ by a multiple of `points` have the same samples, so their coefficients are added.
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(points / 2 + 1);
  for (int n = -functions_ / 2; n <= functions_ / 2; ++n) {
    const int bin = (n % points + points) % points;
    if (2 * static_cast<long long>(bin) > points) continue;  // conjugate of a bin that is kept
    spectrum[bin] += fourier_coefficient(n) * derivative_symbol(n, derivative);
  }
  Eigen::VectorXd values(points);
  RealFft(points).inverse({spectrum.data(), static_cast<std::size_t>(spectrum.size())},
                          {values.data(), static_cast<std::size_t>(points)});
  return values;
}

}  // namespace wavebalance::spectral
