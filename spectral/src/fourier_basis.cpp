#include "wavebalance/spectral/fourier_basis.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

#include "derivative_symbol.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::spectral {
namespace {

void require_at_least(const char* name, int value, int least) {
  if (value >= least) return;
  throw std::invalid_argument("FourierBasis: " + std::string(name) + " is " + std::to_string(value) +
                              "; it must be at least " + std::to_string(least));
}

void require_representable(int functions, int derivative) {
  if (derivative * std::log10(std::numbers::pi * functions + 1.0) < 300.0) return;
  throw std::invalid_argument("FourierBasis::samples: derivative is " + std::to_string(derivative) +
                              "; with " + std::to_string(functions) +
                              " functions its values do not fit a double");
}

}  // namespace

FourierBasis::FourierBasis(int functions, Nyquist nyquist) : functions_(functions), nyquist_(nyquist) {
  require_at_least("functions", functions, 1);
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
  require_at_least("points", points, 1);
  require_at_least("derivative", derivative, 0);
  require_representable(functions_, derivative);
  // Harmonics that differ by a multiple of `points` have the same samples: add them up.
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(points / 2 + 1);
  for (int n = -functions_ / 2; n <= functions_ / 2; ++n) {
    const int bin = (n % points + points) % points;
    if (2 * static_cast<long long>(bin) > points) continue;  // the conjugate of a bin that is kept
    spectrum[bin] += fourier_coefficient(n) * derivative_symbol(n, derivative);
  }
  Eigen::VectorXd values(points);
  RealFft(points).inverse({spectrum.data(), static_cast<std::size_t>(spectrum.size())},
                          {values.data(), static_cast<std::size_t>(points)});
  return values;
}

}  // namespace wavebalance::spectral
