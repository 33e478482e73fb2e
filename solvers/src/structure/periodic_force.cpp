#include "wavebalance/solvers/structure/periodic_force.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

}  // namespace

Eigen::VectorXcd PeriodicForce::amplitudes(double frequency) const {
  Eigen::VectorXcd result = harmonics;
  if (result.size() > 0) result[0] = derivative == 0 ? result[0].real() : 0.0;
  for (Index m = 1; m < result.size(); ++m)
    for (int d = 0; d < derivative; ++d)
      result[m] *= std::complex<double>(0.0, two_pi * double(m) * frequency);
  return result;
}

double series_value(const Eigen::VectorXcd& amplitudes, double periods) {
  const std::complex<double> turn = std::polar(1.0, two_pi * periods);
  std::complex<double> sum = 0.0;
  for (Index m = amplitudes.size() - 1; m >= 0; --m) sum = sum * turn + amplitudes[m];
  return sum.real();
}

double series_slope(const Eigen::VectorXcd& amplitudes, double periods) {
  const std::complex<double> turn = std::polar(1.0, two_pi * periods);
  std::complex<double> sum = 0.0;
  for (Index m = amplitudes.size() - 1; m > 0; --m) sum = sum * turn + double(m) * amplitudes[m];
  return -two_pi * (sum * turn).imag();
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
