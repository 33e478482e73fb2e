#include "balance/velocity_map.hpp"

#include <stdexcept>
#include <utility>

#include "linalg/spans.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {

VelocityMap::VelocityMap(const TimePair& pair)
    : functions_(pair.functions()),
      points_(pair.points()),
      trial_(pair.trial_spectrum()),
      fft_(std::make_unique<spectral::RealFft>(pair.points())) {
  if (pair.trial().pointwise_derivatives() < 1)
    throw std::invalid_argument(
        "VelocityMap: the force of a law depends on the velocity, and the trial functions have no derivative at "
        "points; take others, Fourier for example");
  const double offset = pair.first_sample() > 0.0 ? 0.5 : 0.0;
  rate_ = sampled_spectrum(pair.trial(), points_, 1, offset);
  spectrum_.resize(points_ / 2 + 1);
  AliasMap{functions_, points_}.fold(trial_, trial_, translates_);
  constexpr double rounding = 1e-12;
  const Eigen::VectorXd sums = translates_.real();
  inverse_ = (sums.array() > rounding * sums.maxCoeff()).select(sums.cwiseInverse(), 0.0);
  if (pair.drops_nyquist()) inverse_[functions_ / 2] = 0.0;
}

VelocityMap::~VelocityMap() = default;

void VelocityMap::analyse(const Eigen::VectorXd& samples, int contact) {
  fft_->forward(block_of(samples, contact, points_), span_of(spectrum_));
  AliasMap{functions_, points_}.fold(trial_, spectrum_, translates_);
  translates_.array() *= inverse_.array();
}

Eigen::VectorXd VelocityMap::coefficients(const Eigen::VectorXd& samples) {
  const int contacts = static_cast<int>(samples.size()) / points_;
  Eigen::VectorXd result(contacts * functions_);
  for (int c = 0; c < contacts; ++c) {
    analyse(samples, c);
    result.segment(c * functions_, functions_) = translate_coefficients(translates_, functions_);
  }
  return result;
}

Eigen::VectorXd VelocityMap::motion(const Eigen::VectorXd& coefficients) {
  const int contacts = static_cast<int>(coefficients.size()) / functions_;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(contacts * points_);
  for (int c = 0; c < contacts; ++c) {
    const auto own = coefficients.segment(c * functions_, functions_);
    if (own.isZero(0.0)) continue;
    AliasMap{functions_, points_}.replicate(trial_, translate_spectrum(own), spectrum_);
    fft_->inverse(span_of(std::as_const(spectrum_)), block_of(result, c, points_));
  }
  return result / points_;
}

void VelocityMap::apply(const Eigen::VectorXd& samples, double frequency, Eigen::VectorXd& velocity) {
  velocity.resize(samples.size());
  const int contacts = static_cast<int>(samples.size()) / points_;
  for (int c = 0; c < contacts; ++c) {
    analyse(samples, c);
    AliasMap{functions_, points_}.replicate(rate_, translates_, spectrum_);
    fft_->inverse(span_of(std::as_const(spectrum_)), block_of(velocity, c, points_));
  }
  velocity *= frequency / points_;
}

}  // namespace wavebalance::solvers
