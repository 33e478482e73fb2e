#include "wavebalance/spectral/trigonometric_transform.hpp"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "derivative_symbol.hpp"

namespace wavebalance::spectral {
namespace {

int validated_points(int functions, int points, Nyquist nyquist) {
  if (functions < 1)
    throw std::invalid_argument("TrigonometricTransform: functions is " + std::to_string(functions) +
                                "; it must be at least 1");
  const int least = functions + (functions % 2 == 0 && nyquist == Nyquist::sine ? 1 : 0);
  if (points >= least) return points;
  throw std::invalid_argument("TrigonometricTransform: points is " + std::to_string(points) + "; " +
                              std::to_string(functions) + " functions need at least " +
                              std::to_string(least));
}

void require(const char* call, const char* argument, Eigen::Index found, int wanted, int derivative) {
  const std::string prefix = "TrigonometricTransform::" + std::string(call) + ": ";
  if (found != wanted)
    throw std::invalid_argument(prefix + argument + " has " + std::to_string(found) + " entries; " +
                                std::to_string(wanted) + " are needed");
  if (derivative < 0)
    throw std::invalid_argument(prefix + "derivative is " + std::to_string(derivative) +
                                "; it must be at least 0");
}

template <class Vector>
auto as_span(Vector& vector) {
  return std::span(vector.data(), static_cast<std::size_t>(vector.size()));
}

}  // namespace

TrigonometricTransform::TrigonometricTransform(int functions, int points, Nyquist nyquist)
    : functions_(functions), nyquist_(nyquist), fft_(validated_points(functions, points, nyquist)) {
  spectrum_.resize(fft_.harmonics());
}

Eigen::VectorXd TrigonometricTransform::inverse(const Eigen::Ref<const Eigen::VectorXd>& coefficients,
                                                int derivative) {
  require("inverse", "coefficients", coefficients.size(), functions_, derivative);
  spectrum_.setZero();
  spectrum_[0] = coefficients[0] * derivative_symbol(0, derivative);
  for (int n = 1; 2 * n <= functions_; ++n) {
    const bool last = 2 * n == functions_;
    const bool only_sine = last && nyquist_ == Nyquist::sine;
    const double cosine = only_sine ? 0.0 : coefficients[2 * n - 1];
    const double sine = only_sine ? coefficients[2 * n - 1] : last ? 0.0 : coefficients[2 * n];
    spectrum_[n] = 0.5 * std::complex<double>(cosine, -sine) * derivative_symbol(n, derivative);
    if (2 * n == points())
      spectrum_[n] = 2.0 * spectrum_[n].real();  // harmonics n and -n have the same samples
  }
  Eigen::VectorXd samples(points());
  fft_.inverse(as_span(spectrum_), as_span(samples));
  return samples;
}

Eigen::VectorXd TrigonometricTransform::forward(const Eigen::Ref<const Eigen::VectorXd>& samples,
                                                int derivative) {
  require("forward", "samples", samples.size(), points(), derivative);
  fft_.forward(as_span(samples), as_span(spectrum_));
  spectrum_ /= points();
  Eigen::VectorXd coefficients(functions_);
  coefficients[0] = (spectrum_[0] * derivative_symbol(0, derivative)).real();
  for (int n = 1; 2 * n <= functions_; ++n) {
    const double both = 2 * n == points() ? 1.0 : 2.0;
    const std::complex<double> value = both * spectrum_[n] * derivative_symbol(n, derivative);
    const bool last = 2 * n == functions_;
    coefficients[2 * n - 1] = last && nyquist_ == Nyquist::sine ? -value.imag() : value.real();
    if (!last) coefficients[2 * n] = -value.imag();
  }
  return coefficients;
}

Eigen::VectorXcd to_complex(const Eigen::Ref<const Eigen::VectorXd>& real) {
  if (real.size() % 2 == 0)
    throw std::invalid_argument("to_complex: there are " + std::to_string(real.size()) +
                                " coefficients; the number must be odd, 2H+1");
  Eigen::VectorXcd complex(real.size() / 2 + 1);
  complex[0] = real[0];
  for (Eigen::Index n = 1; n < complex.size(); ++n) complex[n] = {0.5 * real[2 * n - 1], -0.5 * real[2 * n]};
  return complex;
}

Eigen::VectorXd to_real(const Eigen::Ref<const Eigen::VectorXcd>& complex) {
  if (complex.size() == 0) throw std::invalid_argument("to_real: there are 0 coefficients; one is the least");
  Eigen::VectorXd real(2 * complex.size() - 1);
  real[0] = complex[0].real();
  for (Eigen::Index n = 1; n < complex.size(); ++n) {
    real[2 * n - 1] = 2.0 * complex[n].real();
    real[2 * n] = -2.0 * complex[n].imag();
  }
  return real;
}

}  // namespace wavebalance::spectral
