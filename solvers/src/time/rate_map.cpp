#include "time/rate_map.hpp"

#include <stdexcept>
#include <utility>

#include "linalg/spans.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {

RateMap::RateMap(const TimePair& pair)
    : functions_(pair.functions()),
      points_(pair.points()),
      trial_(pair.trial_spectrum()),
      fft_(std::make_unique<spectral::RealFft>(pair.points())) {
  if (pair.trial().pointwise_derivatives() < 1)
    throw std::invalid_argument(
        "RateMap: the force of a law depends on the velocity, and the trial functions have no derivative at "
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

RateMap::~RateMap() = default;

void RateMap::map(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis,
                  const Eigen::VectorXcd& synthesis, double frequency, Eigen::VectorXd& out) {
  out.resize(in.size());
  const AliasMap index{functions_, points_};
  const int contacts = static_cast<int>(in.size()) / points_;
  for (int c = 0; c < contacts; ++c) {
    fft_->forward(block_of(in, c, points_), span_of(spectrum_));
    index.fold(analysis, spectrum_, translates_);
    translates_.array() *= inverse_.array();
    index.replicate(synthesis, translates_, spectrum_);
    fft_->inverse(span_of(std::as_const(spectrum_)), block_of(out, c, points_));
  }
  out *= frequency / points_;
}

void RateMap::apply(const Eigen::VectorXd& samples, double frequency, Eigen::VectorXd& velocity) {
  map(samples, trial_, rate_, frequency, velocity);
}

// Exchanging the two bases transposes the map.
void RateMap::apply_transposed(const Eigen::VectorXd& values, double frequency, Eigen::VectorXd& samples) {
  map(values, rate_, trial_, frequency, samples);
}

}  // namespace wavebalance::solvers
