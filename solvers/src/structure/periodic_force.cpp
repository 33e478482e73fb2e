#include "wavebalance/solvers/structure/periodic_force.hpp"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <numeric>

#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Through the values, or their derivative by the frequency within the places.
double interpolated(const FrequencyFactor& factor, double frequency, bool derivative) {
  const auto count = static_cast<std::size_t>(factor.frequencies.size());
  const gsl_interp_type* type = count < 3 ? gsl_interp_linear : gsl_interp_steffen;
  const std::unique_ptr<gsl_interp, void (*)(gsl_interp*)> through(gsl_interp_alloc(type, count),
                                                                   gsl_interp_free);
  const double *x = factor.frequencies.data(), *y = factor.values.data();
  gsl_interp_init(through.get(), x, y, count);
  const double inside = std::clamp(frequency, x[0], x[count - 1]);
  return derivative ? gsl_interp_eval_deriv(through.get(), x, y, inside, nullptr)
                    : gsl_interp_eval(through.get(), x, y, inside, nullptr);
}

}  // namespace

double FrequencyFactor::at(double frequency) const {
  return frequencies.size() == 0 ? 1.0 : interpolated(*this, frequency, false);
}

double FrequencyFactor::slope(double frequency) const {
  if (frequencies.size() == 0 || frequency < frequencies[0] ||
      frequency > frequencies[frequencies.size() - 1])
    return 0.0;
  return interpolated(*this, frequency, true);
}

bool FrequencyFactor::operator==(const FrequencyFactor& other) const {
  return frequencies.size() == other.frequencies.size() && frequencies == other.frequencies &&
         values == other.values;
}

Eigen::VectorXcd PeriodicForce::amplitudes(double frequency) const {
  Eigen::VectorXcd result = harmonics;
  if (result.size() > 0) result[0] = derivative == 0 ? result[0].real() : 0.0;
  for (Index m = 1; m < result.size(); ++m)
    for (int d = 0; d < derivative; ++d)
      result[m] *= std::complex<double>(0.0, two_pi * double(m) * frequency);
  result *= factor.at(frequency);
  return result;
}

double series_value(const Eigen::VectorXcd& amplitudes, double periods) {
  const std::complex<double> turn = std::polar(1.0, two_pi * periods);
  std::complex<double> sum = 0.0;
  for (Index m = amplitudes.size() - 1; m >= 0; --m) sum = sum * turn + amplitudes[m];
  return sum.real();
}

int repeats_within_period(const Eigen::VectorXcd& harmonics) {
  int common = 0;
  for (Index n = 1; n < harmonics.size(); ++n)
    if (harmonics[n] != 0.0) common = std::gcd(common, static_cast<int>(n));
  return std::max(1, common);
}

Eigen::VectorXcd over_periods(const Eigen::VectorXcd& harmonics, int times) {
  if (times == 1 || harmonics.size() == 0) return harmonics;
  Eigen::VectorXcd result = Eigen::VectorXcd::Zero((harmonics.size() - 1) * times + 1);
  for (Index m = 0; m < harmonics.size(); ++m) result[m * times] = harmonics[m];
  return result;
}

}  // namespace wavebalance::solvers
