#include "wavebalance/solvers/time/translate_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "linalg/spans.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {
namespace {

int fine_points(const AnyTimeBasis& basis, int points) {
  if (points < 1)
    throw std::invalid_argument("TrialEvaluator: points is " + std::to_string(points) +
                                "; at least 1 is needed");
  const int functions = basis.functions();
  if (basis.band_limited())
    return points >= functions ? points : points * ((functions + points - 1) / points);
  if (points % functions == 0) return points;
  if (functions % points == 0) return functions;
  throw std::invalid_argument("TrialEvaluator: points is " + std::to_string(points) +
                              "; it must be a multiple or a divisor of the " + std::to_string(functions) +
                              " functions");
}

}  // namespace

void AliasMap::replicate(const Eigen::VectorXcd& factor, const Eigen::Ref<const Eigen::VectorXcd>& translates,
                         Eigen::VectorXcd& out) const {
  const int size = points / 2 + 1;
  out.resize(size);
  for (int start = 0; start < size; start += functions) {
    const int direct = std::min(functions / 2 + 1, size - start);
    out.segment(start, direct) = factor.segment(start, direct).cwiseProduct(translates.head(direct));
    const int end = std::min(start + functions, size);
    for (int n = start + direct; n < end; ++n)
      out[n] = factor[n] * std::conj(translates[start + functions - n]);
  }
}

// Harmonic n > 0 of a real period also represents -n, unless it is its own conjugate.
void AliasMap::fold(const Eigen::VectorXcd& factor, const Eigen::VectorXcd& samples,
                    Eigen::VectorXcd& out) const {
  const int size = points / 2 + 1, stored = functions / 2 + 1;
  const int largest = (points - 1) / 2;
  out.setZero(stored);
  for (int start = 0; start < size; start += functions) {
    const int count = std::min(stored, size - start);
    out.head(count) += factor.segment(start, count).conjugate().cwiseProduct(samples.segment(start, count));
  }
  for (int start = functions; start - stored < largest; start += functions) {
    const int first = std::max(0, start - largest), last = std::min(stored, start) - 1;
    const int from = start - last, count = last - first + 1;
    if (count <= 0) continue;
    out.segment(first, count) +=
        factor.segment(from, count).cwiseProduct(samples.segment(from, count).conjugate()).reverse();
  }
}

std::complex<double> derivative_factor(int harmonic, int derivative) {
  const double omega = 2.0 * std::numbers::pi * harmonic;
  const double magnitude = derivative == 0 ? 1.0 : std::pow(omega, derivative);
  constexpr std::complex<double> turns[] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  return turns[derivative % 4] * magnitude;
}

Eigen::VectorXcd sampled_spectrum(const AnyTimeBasis& basis, int points, int derivative, double offset) {
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(points / 2 + 1);
  if (basis.band_limited() && basis.functions() < points) {
    for (int n = 0; n <= basis.functions() / 2; ++n) {
      spectrum[n] = double(points) * basis.fourier_coefficient(n) * derivative_factor(n, derivative);
      if (offset != 0.0) spectrum[n] *= std::polar(1.0, 2.0 * std::numbers::pi * n * offset / points);
    }
    return spectrum;
  }
  spectral::RealFft fft(points);
  Eigen::VectorXd samples = basis.samples(offset == 0.0 ? points : 2 * points, derivative);
  if (offset != 0.0) samples = samples(Eigen::seqN(1, points, 2)).eval();
  fft.forward(span_of(samples), span_of(spectrum));
  return spectrum;
}

TrialEvaluator::TrialEvaluator(const AnyTimeBasis& basis, int points, int derivative)
    : index_{basis.functions(), fine_points(basis, points)},
      points_(points),
      stride_(index_.points / points),
      generator_(sampled_spectrum(basis, index_.points, derivative)),
      values_(index_.points),
      fft_(std::make_unique<spectral::RealFft>(index_.points)) {}

TrialEvaluator::TrialEvaluator(TrialEvaluator&&) noexcept = default;
TrialEvaluator& TrialEvaluator::operator=(TrialEvaluator&&) noexcept = default;
TrialEvaluator::~TrialEvaluator() = default;

Eigen::VectorXd TrialEvaluator::operator()(const Eigen::VectorXcd& coefficients) {
  index_.replicate(generator_, coefficients, spectrum_);
  fft_->inverse(span_of(std::as_const(spectrum_)), span_of(values_));
  const double scale = 1.0 / index_.points;
  if (stride_ == 1) return values_ * scale;
  Eigen::VectorXd coarse(points_);
  for (int l = 0; l < points_; ++l) coarse[l] = values_[l * stride_] * scale;
  return coarse;
}

Eigen::VectorXcd translate_spectrum(const Eigen::VectorXd& coefficients) {
  spectral::RealFft fft(static_cast<int>(coefficients.size()));
  Eigen::VectorXcd spectrum(fft.harmonics());
  fft.forward(span_of(coefficients), span_of(spectrum));
  return spectrum;
}

Eigen::VectorXd translate_coefficients(const Eigen::VectorXcd& spectrum, int functions) {
  if (spectrum.size() != functions / 2 + 1)
    throw std::invalid_argument("translate_coefficients: the spectrum has " +
                                std::to_string(spectrum.size()) + " values; " + std::to_string(functions) +
                                " functions need " + std::to_string(functions / 2 + 1));
  spectral::RealFft fft(functions);
  Eigen::VectorXd coefficients(functions);
  fft.inverse(span_of(spectrum), span_of(coefficients));
  return coefficients / functions;
}

}  // namespace wavebalance::solvers
