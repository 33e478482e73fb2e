#include "wavebalance/wavelets/periodic_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "constants.hpp"

namespace wavebalance::wavelets {
namespace {

TEST(PeriodicBasis, IsTheConstantAtLevelZero) {
  for (const auto& phi : {ScalingFunction::haar(), ScalingFunction::daubechies(6),
                          ScalingFunction::daubechies(40), ScalingFunction::orthonormal_bspline()}) {
    const PeriodicBasis basis(phi, 0);
    EXPECT_EQ(basis.functions(), 1);
    EXPECT_LT((basis.samples(32, 0).array() - 1.0).abs().maxCoeff(), 512 * eps) << phi.name();
    EXPECT_NEAR(std::abs(basis.fourier_coefficient(0) - 1.0), 0.0, 64 * eps);
    EXPECT_NEAR(std::abs(basis.fourier_coefficient(3)), 0.0, 64 * eps);
  }
}

TEST(PeriodicBasis, HaarIsLeftClosed) {
  const Eigen::VectorXd g = PeriodicBasis(ScalingFunction::haar(), 2).samples(8, 0);
  EXPECT_EQ(g, (Eigen::VectorXd(8) << 1, 1, 0, 0, 0, 0, 0, 0).finished());
}

TEST(PeriodicBasis, WrapsTheValuesOfTheLine) {  // g(l/P) = sum_n phi(M (l/P - n)), term by term
  constexpr int fine = 3;
  for (const auto& phi : {ScalingFunction::haar(), ScalingFunction::daubechies(6),
                          ScalingFunction::daubechies(20), ScalingFunction::orthonormal_bspline()})
    for (int level = 0; level <= 8; ++level)
      for (int d = 0; d <= phi.pointwise_derivatives(); ++d) {
        const PeriodicBasis basis(phi, level);
        const int points = basis.functions() << fine;
        const Eigen::VectorXd table = phi.values(fine, d), g = basis.samples(points, d);
        Eigen::VectorXd expected = Eigen::VectorXd::Zero(points);
        for (Eigen::Index n = 0; n < table.size(); ++n) {
          const Eigen::Index at = n + (Eigen::Index{phi.support_begin()} << fine);
          expected[((at % points) + points) % points] += table[n];
        }
        expected *= std::pow(basis.functions(), d);
        EXPECT_LT((g - expected).cwiseAbs().maxCoeff(), 512 * eps * (1 + expected.cwiseAbs().maxCoeff()))
            << phi.name() << " level " << level << " d " << d;
      }
}

TEST(PeriodicBasis, FewerPointsThanFunctionsAreASubsample) {
  for (const auto& phi : {ScalingFunction::daubechies(6), ScalingFunction::orthonormal_bspline()}) {
    const PeriodicBasis basis(phi, 5);
    const Eigen::VectorXd all = basis.samples(32, 1);
    for (const int points : {1, 2, 8, 16}) {
      const Eigen::VectorXd some = basis.samples(points, 1);
      for (int l = 0; l < points; ++l)
        EXPECT_NEAR(some[l], all[l * 32 / points], 512 * eps * all.cwiseAbs().maxCoeff()) << phi.name();
    }
  }
}

TEST(PeriodicBasis, SplinesAcceptAnyNumberOfPoints) {
  for (const auto& phi : {ScalingFunction::haar(), ScalingFunction::orthonormal_bspline()}) {
    const PeriodicBasis basis(phi, 3);
    const Eigen::VectorXd coarse = basis.samples(37, 0), fine = basis.samples(37 * 4, 0);
    for (int l = 0; l < 37; ++l) EXPECT_NEAR(coarse[l], fine[4 * l], 16 * eps) << phi.name();
  }
}

TEST(PeriodicBasis, DerivativesAreWithRespectToTheCircle) {
  for (const auto& phi : {ScalingFunction::daubechies(20), ScalingFunction::orthonormal_bspline()}) {
    const PeriodicBasis basis(phi, 3);
    constexpr int points = 1 << 14;
    const Eigen::VectorXd g = basis.samples(points, 0), slope = basis.samples(points, 1),
                          second = basis.samples(points, 2);
    for (int l = 0; l < points; ++l) {
      const double difference = (g[(l + 1) % points] - g[(l + points - 1) % points]) * points / 2;
      ASSERT_NEAR(difference, slope[l], 0.5 / points * second.cwiseAbs().maxCoeff()) << phi.name();
    }
  }
}

TEST(PeriodicBasis, FourierCoefficientsVanishAtMultiplesOfM) {
  for (const auto& phi :
       {ScalingFunction::haar(), ScalingFunction::daubechies(8), ScalingFunction::orthonormal_bspline()}) {
    const PeriodicBasis basis(phi, 4);
    EXPECT_NEAR(std::abs(basis.fourier_coefficient(0) - 1.0 / 16), 0.0, eps);
    for (const int n : {-48, -16, 16, 32, 1600}) EXPECT_LT(std::abs(basis.fourier_coefficient(n)), 8 * eps);
    for (const int n : {1, 5, 23})
      EXPECT_LT(std::abs(basis.fourier_coefficient(-n) - std::conj(basis.fourier_coefficient(n))), 8 * eps);
  }
}

TEST(PeriodicBasis, HaarFourierCoefficientsAreSincs) {
  const PeriodicBasis basis(ScalingFunction::haar(), 3);
  for (const int n : {1, 2, 7, 1001, 1000001}) {
    const double turn = std::remainder(n / 8.0, 1.0);
    const std::complex<double> expected = (1.0 - std::polar(1.0, -2 * std::numbers::pi * turn)) /
                                          std::complex<double>(0, 2 * std::numbers::pi * n);
    EXPECT_LT(std::abs(basis.fourier_coefficient(n) - expected), 4 * eps / n) << n;
  }
}

TEST(PeriodicBasis, ReachesLargeSizes) {
  for (const auto& phi :
       {ScalingFunction::haar(), ScalingFunction::daubechies(6), ScalingFunction::orthonormal_bspline()}) {
    const PeriodicBasis basis(phi, 14);
    const Eigen::VectorXd g = basis.samples(1 << 16, phi.pointwise_derivatives());
    EXPECT_EQ(g.size(), 1 << 16);
    EXPECT_TRUE(g.allFinite());
  }
}

TEST(PeriodicBasis, SamplesAreValuesUnlessADerivativeIsNamed) {
  const PeriodicBasis basis(ScalingFunction::orthonormal_bspline(), 3);
  EXPECT_EQ(basis.samples(24), basis.samples(24, 0));
}

TEST(PeriodicBasisErrors, NameTheArgumentTheValueAndWhatIsAllowed) {
  EXPECT_THROW(PeriodicBasis(ScalingFunction::haar(), -1), std::invalid_argument);
  EXPECT_THROW(PeriodicBasis(ScalingFunction::haar(), 25), std::invalid_argument);
  const PeriodicBasis basis(ScalingFunction::daubechies(6), 3);
  EXPECT_THROW(basis.samples(0, 0), std::invalid_argument);
  EXPECT_THROW(basis.samples(64, 2), std::invalid_argument);
  EXPECT_THROW(basis.samples(64, -1), std::invalid_argument);
  try {
    basis.samples(48, 0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("points is 48; it must be a power of two for daubechies6"), std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace wavebalance::wavelets
