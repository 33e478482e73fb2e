#include "wavebalance/spectral/fourier_basis.hpp"

#include "testing.hpp"

namespace wavebalance::spectral {
namespace {

using std::numbers::pi;

// d^order/dt^order of cos(2 pi n t + phase), by shifting the phase.
double wave(int n, double t, int order, double phase = 0.0) {
  return std::pow(2 * pi * n, order) * std::cos(2 * pi * n * t + phase + order * pi / 2);
}

double generator(int functions, Nyquist nyquist, double t, int order) {
  double sum = order == 0 ? 1.0 : 0.0;
  for (int n = 1; 2 * n < functions; ++n) sum += 2.0 * wave(n, t, order);
  if (functions % 2 == 0) sum += wave(functions / 2, t, order, nyquist == Nyquist::sine ? -pi / 2 : 0.0);
  return sum / functions;
}

TEST(FourierBasis, SamplesAreTheClosedSum) {
  for (const Nyquist nyquist : {Nyquist::cosine, Nyquist::sine})
    for (int functions : {1, 2, 3, 4, 7, 8, 20})
      for (int points : {1, 2, 3, 5, 8, 20, 33, 64})
        for (int order : {0, 1, 2, 3, 5}) {
          const Eigen::VectorXd found = FourierBasis(functions, nyquist).samples(points, order);
          const double scale = std::pow(pi * functions, order);
          ASSERT_EQ(found.size(), points);
          for (int l = 0; l < points; ++l)
            EXPECT_NEAR(found[l], generator(functions, nyquist, double(l) / points, order), 100 * eps * scale)
                << functions << " functions, " << points << " points, derivative " << order;
        }
}

TEST(FourierBasis, IsCardinal) {
  for (int functions : {1, 2, 5, 16, 64, 101}) {
    const Eigen::VectorXd found = FourierBasis(functions).samples(functions, 0);
    EXPECT_LE((found - Eigen::VectorXd::Unit(functions, 0)).cwiseAbs().maxCoeff(), 8 * eps);
  }
}

TEST(FourierBasis, TranslatesSumToOne) {
  for (int functions : {1, 2, 3, 8, 15})
    for (const Nyquist nyquist : {Nyquist::cosine, Nyquist::sine}) {
      const int fine = 6;
      const Eigen::VectorXd g = FourierBasis(functions, nyquist).samples(fine * functions, 0);
      for (int l = 0; l < fine; ++l) {
        const Eigen::VectorXd translates = g(Eigen::seqN(l, functions, fine));
        EXPECT_NEAR(translates.sum(), 1.0, 32 * eps);
      }
    }
}

TEST(FourierBasis, CoefficientsAreTheIntegralsOfTheSamples) {
  for (int functions : {1, 2, 5, 8})
    for (const Nyquist nyquist : {Nyquist::cosine, Nyquist::sine}) {
      const FourierBasis basis(functions, nyquist);
      const int points = 40;
      const Eigen::VectorXd g = basis.samples(points, 0);
      for (int n = -12; n <= 12; ++n) {
        std::complex<double> sum = 0.0;
        for (int l = 0; l < points; ++l) sum += g[l] * std::polar(1.0 / points, -2 * pi * n * l / points);
        EXPECT_LE(std::abs(sum - basis.fourier_coefficient(n)), 32 * eps)
            << functions << " functions, n = " << n;
      }
    }
}

TEST(FourierBasis, IsAnalyticAndBandLimited) {
  const FourierBasis basis(9);
  EXPECT_TRUE(std::isinf(basis.sobolev_exponent()));
  EXPECT_TRUE(basis.band_limited());
  EXPECT_GE(basis.pointwise_derivatives(), 100);
  EXPECT_EQ(basis.fourier_coefficient(std::numeric_limits<int>::min()), 0.0);
}

TEST(FourierBasis, RejectsWhatItCannotDo) {
  EXPECT_THROW(FourierBasis(0), std::invalid_argument);
  const FourierBasis basis(8);
  EXPECT_THROW(basis.samples(0, 0), std::invalid_argument);
  EXPECT_THROW(basis.samples(8, -1), std::invalid_argument);
  EXPECT_THROW(basis.samples(8, 1000), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::spectral
