#include "flow/harmonic_series.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "linalg/index.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Between instants so dense the terms left out are below 1e-15 of the highest harmonic and of its
// derivatives.
constexpr int taylor_terms = 14, instants_per_harmonic = 16;

// Each row the derivative of one order over its factorial, at uniform instants.
Eigen::MatrixXd series_by_instants(const Eigen::VectorXcd& amplitudes) {
  Index instants = 1;
  while (instants < instants_per_harmonic * (amplitudes.size() - 1)) instants *= 2;
  spectral::RealFft transform(static_cast<int>(instants));
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(transform.harmonics());
  spectrum.head(amplitudes.size()) = 0.5 * amplitudes;
  spectrum[0] *= 2.0;
  Eigen::MatrixXd taylor(taylor_terms, instants);
  Eigen::VectorXd values(instants);
  for (Index term = 0; term < taylor_terms; ++term) {
    transform.inverse({spectrum.data(), std::size_t(spectrum.size())},
                      {values.data(), std::size_t(values.size())});
    taylor.row(term) = values.transpose();
    for (Index n = 0; n < amplitudes.size(); ++n)
      spectrum[n] *= std::complex<double>(0.0, double(n) / double(term + 1));
  }
  return taylor;
}

}  // namespace

HarmonicSeries::HarmonicSeries(Eigen::VectorXcd amplitudes, double rate)
    : amplitudes_(std::move(amplitudes)), rate_(rate) {
  constexpr Index few = 64;
  if ((amplitudes_.array() != 0.0).count() > few) taylor_ = series_by_instants(amplitudes_);
}

std::array<double, 4> HarmonicSeries::summed(double time) const {
  std::array<double, 4> sum{};
  for (Index n = 0; n < amplitudes_.size(); ++n) {
    if (amplitudes_[n] == 0.0) continue;
    const double speed = rate_ * double(n);
    const std::complex<double> value =
        amplitudes_[n] * std::polar(1.0, 2.0 * std::numbers::pi * double(n) * time);
    sum[0] += value.real();
    sum[1] -= speed * value.imag();
    sum[2] -= speed * speed * value.real();
    sum[3] += speed * speed * speed * value.imag();
  }
  return sum;
}

std::array<double, 4> HarmonicSeries::at(double time) const {
  const Index instants = taylor_.cols();
  if (instants == 0) return summed(time);
  const double place = (time - std::floor(time)) * double(instants), nearest = std::round(place);
  const double way = 2.0 * std::numbers::pi * (place - nearest) / double(instants);
  const auto column = taylor_.col(static_cast<Index>(nearest) % instants);
  double value = 0.0, first = 0.0, second = 0.0, third = 0.0;  // by Horner's scheme, over factorials
  for (Index term = taylor_terms - 1; term >= 0; --term) {
    third = third * way + second;
    second = second * way + first;
    first = first * way + value;
    value = value * way + column[term];
  }
  return {value, rate_ * first, 2.0 * rate_ * rate_ * second, 6.0 * rate_ * rate_ * rate_ * third};
}

}  // namespace wavebalance::solvers::detail
