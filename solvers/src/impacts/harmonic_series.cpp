#include "impacts/harmonic_series.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "linalg/index.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

// Between instants so dense the terms left out are below 1e-16 of the highest harmonic and of its second
// derivative.
constexpr int terms = 14, instants_per_harmonic = 16;

// Each row the derivative of one order over its factorial, at uniform instants.
Eigen::MatrixXd taylor_of(const Eigen::VectorXcd& amplitudes) {
  Index instants = 1;
  while (instants < instants_per_harmonic * (amplitudes.size() - 1)) instants *= 2;
  spectral::RealFft transform(static_cast<int>(instants));
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(transform.harmonics());
  spectrum.head(amplitudes.size()) = 0.5 * amplitudes;
  spectrum[0] *= 2.0;
  Eigen::MatrixXd taylor(terms, instants);
  Eigen::VectorXd values(instants);
  for (Index term = 0; term < terms; ++term) {
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
  if ((amplitudes_.array() != 0.0).count() > few) taylor_ = taylor_of(amplitudes_);
}

std::array<double, 3> HarmonicSeries::summed(double time) const {
  std::array<double, 3> sum{};
  for (Index n = 0; n < amplitudes_.size(); ++n) {
    if (amplitudes_[n] == 0.0) continue;
    const double speed = rate_ * double(n);
    const std::complex<double> value = amplitudes_[n] * std::polar(1.0, turn * double(n) * time);
    sum[0] += value.real();
    sum[1] -= speed * value.imag();
    sum[2] -= speed * speed * value.real();
  }
  return sum;
}

std::array<double, 3> HarmonicSeries::at(double time) const {
  const Index instants = taylor_.cols();
  if (instants == 0) return summed(time);
  const double place = (time - std::floor(time)) * double(instants), nearest = std::round(place);
  const double way = turn * (place - nearest) / double(instants);
  const auto column = taylor_.col(static_cast<Index>(nearest) % instants);
  double value = 0.0, first = 0.0, second = 0.0;  // by Horner's scheme, the second derivative halved
  for (Index term = terms - 1; term >= 0; --term) {
    second = second * way + first;
    first = first * way + value;
    value = value * way + column[term];
  }
  return {value, rate_ * first, 2.0 * rate_ * rate_ * second};
}

}  // namespace wavebalance::solvers::detail
