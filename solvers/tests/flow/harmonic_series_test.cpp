#include "flow/harmonic_series.hpp"

#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

// Amplitudes that decay as in a motion under a load with kinks.
Eigen::VectorXcd kinked(int harmonics) {
  std::mt19937 engine(20140817);
  std::normal_distribution<double> number;
  Eigen::VectorXcd amplitudes(harmonics + 1);
  for (int n = 0; n <= harmonics; ++n)
    amplitudes[n] = std::complex<double>(number(engine), number(engine)) / std::pow(1.0 + n, 3);
  return amplitudes;
}

TEST(HarmonicSeriesTest, OfManyHarmonicsHasTheValuesOfTheirSumBetweenItsInstantsToo) {
  constexpr double rate = 3.0;
  for (const int harmonics : {5, 64, 65, 200, 1000}) {
    const Eigen::VectorXcd amplitudes = kinked(harmonics);
    const detail::HarmonicSeries series(amplitudes, rate);
    std::array<double, 4> scale{};
    for (int n = 0; n <= harmonics; ++n)
      for (int d = 0; d < 4; ++d) scale[std::size_t(d)] += std::abs(amplitudes[n]) * std::pow(n * rate, d);
    for (const double time : {0.0, 0.1, 0.123456789, 0.5, 0.99999, 1.0 - 1e-16, -0.3, 7.77}) {
      std::array<std::complex<double>, 4> sum{};
      for (int n = 0; n <= harmonics; ++n) {
        const std::complex<double> step(0.0, n * rate);
        const std::complex<double> value = amplitudes[n] * std::polar(1.0, two_pi * n * time);
        sum[0] += value;
        sum[1] += step * value;
        sum[2] += step * step * value;
        sum[3] += step * step * step * value;
      }
      const std::array<double, 4> found = series.at(time);
      for (std::size_t d = 0; d < 4; ++d)
        EXPECT_NEAR(found[d], sum[d].real(), 1e-13 * (1.0 + harmonics * std::abs(time)) * scale[d])
            << harmonics << " harmonics at " << time << ", derivative " << d;
    }
  }
}

}  // namespace
}  // namespace wavebalance::solvers
