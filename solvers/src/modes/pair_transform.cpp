#include "modes/pair_transform.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/spans.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

[[noreturn]] void reject_damping(int harmonic, double share) {
  std::ostringstream message;
  message << "ElasticMode: the pair of bases damps a free motion: at harmonic " << harmonic
          << " the imaginary part of symbol(2) / symbol(0) is " << share
          << " of it; take one basis on both sides, or Fourier weights";
  throw std::invalid_argument(message.str());
}

/// inertia[k]; throws where it is not real or, from k = 1 on, not positive.
Eigen::VectorXd inertia_of(const TimePair& pair, int highest) {
  constexpr double rounding = 1e-9, four_pi_squared = 4.0 * std::numbers::pi * std::numbers::pi;
  Eigen::VectorXd inertia = Eigen::VectorXd::Zero(highest + 1);
  double largest = rounding;
  int worst = 0;
  for (int k = 1; k <= highest; ++k) {
    const Complex ratio = -pair.symbol(2)[k] / (four_pi_squared * pair.symbol(0)[k]);
    inertia[k] = ratio.real();
    const double share = ratio.real() > 0.0 ? std::abs(ratio.imag()) / std::abs(ratio) : 1.0;
    if (share <= largest) continue;
    largest = share;
    worst = k;
  }
  if (worst > 0) reject_damping(worst, largest);
  return inertia;
}

/// Columns: what real and imaginary unit coefficients give with the spectrum of a generator, times N.
Eigen::MatrixXd unit_samples(const TimePair& pair, const Eigen::VectorXcd& generator,
                             const PairTransform& transform) {
  spectral::RealFft fft(pair.points());
  const AliasMap index{pair.functions(), pair.points()};
  Eigen::MatrixXd result(pair.points(), transform.rows());
  Eigen::VectorXcd unit(pair.spectrum_size()), spectrum;
  Eigen::VectorXd samples(pair.points());
  for (int row = 0; row < transform.rows(); ++row) {
    const int k = transform.order[static_cast<std::size_t>(row)];
    const bool imaginary = row != transform.real_rows[static_cast<std::size_t>(k)];
    unit.setZero();
    unit[k] = imaginary ? Complex(0.0, 1.0) : Complex(1.0, 0.0);
    index.replicate(generator, unit, spectrum);
    fft.inverse(span_of(std::as_const(spectrum)), span_of(samples));
    result.col(row) = samples;
  }
  return result;
}

/// Divides each spectrum in the rows by symbol(0).
void divide_by_symbol(const TimePair& pair, PairTransform& transform) {
  for (int k = 0; k <= transform.highest(); ++k) {
    const Complex factor = 1.0 / pair.symbol(0)[k];
    const int row = transform.real_rows[static_cast<std::size_t>(k)];
    if (k == 0 || !transform.has_sines()) {
      transform.projection.row(row) *= factor.real();
      continue;
    }
    const Eigen::RowVectorXd real = transform.projection.row(row);
    const Eigen::RowVectorXd imaginary = transform.projection.row(row + 1);
    transform.projection.row(row) = factor.real() * real - factor.imag() * imaginary;
    transform.projection.row(row + 1) = factor.imag() * real + factor.real() * imaginary;
  }
}

/// Harmonics of the samples: n = k or, conjugated, n = -k modulo M.
void set_harmonics(const TimePair& pair, PairTransform& transform) {
  const int points = pair.points(), functions = pair.functions();
  const int highest = pair.trial().band_limited() ? transform.highest() : points / 2;
  transform.harmonics = Eigen::MatrixXcd::Zero(highest + 1, transform.highest() + 1);
  transform.conjugated = transform.harmonics;
  for (int n = 0; n <= highest; ++n) {
    const double once = points % 2 == 0 && n == points / 2 ? 0.5 : 1.0;  // counted once, not as +n and -n
    const Complex factor = once / points * pair.trial_spectrum()[n];
    const int k = n % functions;
    if (k <= transform.highest())
      transform.harmonics(n, k) = factor;
    else if (functions - k <= transform.highest())
      transform.conjugated(n, functions - k) = factor;
  }
}

}  // namespace

Eigen::VectorXcd PairTransform::spectrum(const Eigen::VectorXd& coefficients) const {
  Eigen::VectorXcd result(highest() + 1);
  for (int k = 0; k <= highest(); ++k) {
    const int row = real_rows[static_cast<std::size_t>(k)];
    result[k] = {coefficients[row], k > 0 && has_sines() ? coefficients[row + 1] : 0.0};
  }
  return result;
}

namespace {

/// All but the inertia. `who` begins messages.
PairTransform transform_of(const TimePair& pair, bool cosine_only, const std::string& who) {
  const int highest = (pair.functions() - 1) / 2;
  if (highest < 1)
    throw std::invalid_argument(who + ": the pair has " + std::to_string(pair.functions()) +
                                " functions; a mode needs at least 3");
  if (pair.first_sample() != 0.0)
    throw std::invalid_argument(
        who +
        ": the pair has a sample_offset of 0.5; it must be 0, with which motions even in time have even samples");
  if (cosine_only && !(pair.trial().band_limited() && pair.weight().band_limited()))
    throw std::invalid_argument(who + ": cosine_only is true; only Fourier bases have even motions");
  PairTransform transform;
  for (int k = 0; k <= highest; ++k) {
    transform.real_rows.push_back(transform.rows());
    for (int part = 0; part < (k == 0 || cosine_only ? 1 : 2); ++part) transform.order.push_back(k);
  }
  const double points = pair.points();
  transform.synthesis = unit_samples(pair, pair.trial_spectrum(), transform) / points;
  transform.projection = unit_samples(pair, pair.weight_spectrum(), transform).transpose();
  transform.projection *= 0.5 * pair.functions() / points / points;
  transform.projection.row(0) *= 2.0;  // a mean has no conjugate partner
  divide_by_symbol(pair, transform);
  transform.mean_square = transform.synthesis.colwise().squaredNorm().transpose() / points;
  set_harmonics(pair, transform);
  return transform;
}

}  // namespace

PairTransform make_pair_transform(const TimePair& pair, bool cosine_only) {
  PairTransform transform = transform_of(pair, cosine_only, "ElasticMode");
  transform.inertia = inertia_of(pair, transform.highest());
  return transform;
}

DampedTransform make_damped_transform(const TimePair& pair) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  DampedTransform damped{transform_of(pair, false, "DampedMode"), {}, {}, {}};
  const Eigen::Index count = damped.pair.highest() + 1;
  const auto zeroth = pair.symbol(0).head(count).array();
  damped.first = pair.symbol(1).head(count).array() / zeroth / two_pi;
  damped.second = pair.symbol(2).head(count).array() / zeroth / (two_pi * two_pi);
  if (pair.trial().pointwise_derivatives() < 1) return damped;
  spectral::RealFft fft(pair.points());
  const Eigen::VectorXd rate = pair.trial().samples(pair.points(), 1);
  Eigen::VectorXcd spectrum(pair.points() / 2 + 1);
  fft.forward(span_of(rate), span_of(spectrum));
  damped.rate = unit_samples(pair, spectrum, damped.pair) / (two_pi * pair.points());
  return damped;
}

}  // namespace wavebalance::solvers
