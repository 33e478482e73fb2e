#include "branches/perturbation.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "balance/unknown_in_form.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// sum_n harmonics.col(n + H) exp(i (arg mu + 2 pi n) t) at the points of a pair of `periods` periods,
// contact-major.
Eigen::VectorXcd samples(const Eigen::MatrixXcd& harmonics, double angle, int periods, const TimePair& pair) {
  const int points = pair.points();
  const Index highest = harmonics.cols() / 2;
  Eigen::VectorXcd values = Eigen::VectorXcd::Zero(harmonics.rows() * points);
  for (int l = 0; l < points; ++l) {
    const double time = double(periods) * (double(l) / points + pair.first_sample());
    for (Index n = -highest; n <= highest; ++n) {
      const Complex wave = std::polar(1.0, angle * time + 2.0 * std::numbers::pi * double(n) * time);
      for (Index c = 0; c < harmonics.rows(); ++c) values[c * points + l] += harmonics(c, n + highest) * wave;
    }
  }
  return values;
}

}  // namespace

Eigen::VectorXd Perturbation::unknown(const Eigen::VectorXd& series_flexibility) const {
  return detail::unknown_in_form(displacement, force, series_flexibility);
}

Perturbation perturbation(const FloquetExponent& exponent, int periods, const TimePair& pair, double phase) {
  if (exponent.displacement.isZero(0.0)) return {};
  const double angle = std::arg(exponent.multiplier);
  const Eigen::VectorXcd motion = samples(exponent.displacement, angle, periods, pair);
  // Re(exp(i phi) w) is largest where exp(2 i phi) sum w^2 is real and positive.
  const Complex turn = std::polar(1.0, phase - 0.5 * std::arg(motion.cwiseProduct(motion).sum()));
  Perturbation result{(turn * motion).real(), {}};
  const double rms = result.displacement.norm() / std::sqrt(double(result.displacement.size()));
  if (!(rms > 0.0)) return {};
  result.displacement /= rms;
  result.force = (turn * samples(exponent.force, angle, periods, pair)).real() / rms;
  return result;
}

}  // namespace wavebalance::solvers
