#include "wavebalance/wavelets/scaling_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "constants.hpp"
#include "wavebalance/wavelets/bspline.hpp"

namespace wavebalance::wavelets {
namespace {

std::vector<ScalingFunction> all_families() {
  std::vector<ScalingFunction> all{ScalingFunction::haar(), ScalingFunction::orthonormal_bspline()};
  for (const int length : {4, 6, 8, 12, 20, 40}) all.push_back(ScalingFunction::daubechies(length));
  return all;
}

// sum over n congruent to r of values, for the residues r modulo 2^level: the sums over integer shifts.
Eigen::VectorXd shift_sums(const Eigen::VectorXd& values, int level) {
  const int one = 1 << level;
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(one);
  for (Eigen::Index n = 0; n < values.size(); ++n) sums[n % one] += values[n];
  return sums;
}

TEST(ScalingFunction, KnowsItsSupport) {
  EXPECT_EQ(ScalingFunction::haar().support_end(), 1);
  const auto db6 = ScalingFunction::daubechies(6);
  EXPECT_EQ(db6.support_begin(), 0);
  EXPECT_EQ(db6.support_end(), 5);
  const auto spline = ScalingFunction::orthonormal_bspline();
  EXPECT_EQ(spline.support_begin(), -50);
  EXPECT_EQ(spline.support_end(), 54);
  for (const auto& phi : all_families())
    EXPECT_EQ(phi.values(3).size(), (phi.support_end() - phi.support_begin()) * 8 + 1) << phi.name();
}

TEST(ScalingFunction, KnowsHowManyDerivativesArePointwise) {
  EXPECT_EQ(ScalingFunction::haar().pointwise_derivatives(), 0);
  EXPECT_EQ(ScalingFunction::orthonormal_bspline().pointwise_derivatives(), 2);
  // Whole parts of the Hoelder exponents
  // .5500, 1.0878, 1.6179, 1.9690, 2.1891, 2.4604, 2.7608, 3.0736, 3.3814.
  const std::vector<int> expected{0, 1, 1, 1, 2, 2, 2, 3, 3};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto phi = ScalingFunction::daubechies(4 + 2 * static_cast<int>(i));
    EXPECT_EQ(phi.pointwise_derivatives(), expected[i]) << phi.name();
  }
}

TEST(ScalingFunction, TwoCoefficientsAreHaar) {
  const auto phi = ScalingFunction::daubechies(2);
  EXPECT_EQ(phi.name(), "haar");
  EXPECT_EQ(phi.values(2), (Eigen::VectorXd(5) << 1, 1, 1, 1, 0).finished());
}

TEST(ScalingFunction, ShiftsSumToOneAndTheirDerivativesToZero) {
  for (const auto& phi : all_families())
    for (int d = 0; d <= phi.pointwise_derivatives(); ++d) {
      const Eigen::VectorXd values = phi.values(5, d);
      const double tolerance = 100 * eps * (1 + values.cwiseAbs().maxCoeff());
      const Eigen::VectorXd sums = shift_sums(values, 5);
      EXPECT_LT((sums.array() - (d == 0 ? 1.0 : 0.0)).abs().maxCoeff(), tolerance)
          << phi.name() << " d = " << d;
    }
}

TEST(ScalingFunction, DerivativesHaveTheMomentsOfTheirOrder) {  // sum_k (k + x)^j phi^(d)(k + x), j <= d
  for (const auto& phi : all_families())
    for (int d = 1; d <= phi.pointwise_derivatives(); ++d)
      for (int power = 0; power <= d; ++power) {
        const Eigen::VectorXd values = phi.values(0, d);
        double moment = 0.0, scale = 0.0;
        for (Eigen::Index n = 0; n < values.size(); ++n) {
          const double term = values[n] * std::pow(phi.support_begin() + static_cast<double>(n), power);
          moment += term;
          scale += std::abs(term);
        }
        const double expected = power < d ? 0.0 : (d % 2 == 0 ? 1 : -1) * std::tgamma(d + 1.0);
        EXPECT_NEAR(moment, expected, 100 * eps * (1 + scale))
            << phi.name() << " d " << d << " power " << power;
      }
}

TEST(ScalingFunction, SatisfiesTheRefinementEquation) {
  for (const int length : {2, 4, 6, 10, 20, 40}) {
    const auto phi = ScalingFunction::daubechies(length);
    for (int d = 0; d <= phi.pointwise_derivatives(); ++d) {
      constexpr int level = 4, one = 1 << level;
      const Eigen::VectorXd values = phi.values(level, d);
      const double tolerance = 512 * eps * length * (1 + values.cwiseAbs().maxCoeff());
      for (Eigen::Index n = 0; n < values.size(); ++n) {  // integers and coarse points included
        double sum = 0.0;
        for (int l = 0; l < length; ++l) {
          const Eigen::Index at = 2 * n - l * one;
          if (at >= 0 && at < values.size()) sum += phi.filter()[l] * values[at];
        }
        EXPECT_NEAR(values[n], std::ldexp(sum, d), tolerance) << phi.name() << " d = " << d << " n = " << n;
      }
    }
  }
}

TEST(ScalingFunction, FirstMomentSquaredIsTheSecond) {  // orthonormal with N >= 3; the Riemann sums are exact
  for (const int length : {6, 8, 12, 20}) {
    const auto phi = ScalingFunction::daubechies(length);
    const Eigen::VectorXd values = phi.values(4);
    double first = 0.0, second = 0.0, filter_moment = 0.0;
    for (Eigen::Index n = 0; n < values.size(); ++n) {
      const double x = static_cast<double>(n) / 16;
      first += x * values[n] / 16;
      second += x * x * values[n] / 16;
    }
    for (int l = 0; l < length; ++l) filter_moment += 0.5 * l * phi.filter()[l];
    EXPECT_NEAR(first, filter_moment, 512 * eps);
    EXPECT_NEAR(second, first * first, 1e-12);
  }
}

TEST(ScalingFunction, FirstDerivativeIsTheLimitOfDifferences) {
  for (const auto& phi : {ScalingFunction::daubechies(14), ScalingFunction::daubechies(20),
                          ScalingFunction::orthonormal_bspline()}) {
    constexpr int level = 11;
    const double h = std::ldexp(1.0, -level);
    const Eigen::VectorXd values = phi.values(level), slope = phi.values(level, 1),
                          second = phi.values(level, 2);
    double error = 0.0;
    for (Eigen::Index n = 1; n + 1 < values.size(); ++n)
      error = std::max(error, std::abs((values[n + 1] - values[n - 1]) / (2 * h) - slope[n]));
    // |phi'(x + s) - phi'(x)| <= h max|phi''| for |s| <= h
    EXPECT_LT(error, 0.5 * h * second.cwiseAbs().maxCoeff()) << phi.name();
  }
}

// phi' of six coefficients has Hoelder exponent 0.0878 only: its integral, not its differences, is compared.
TEST(ScalingFunction, SixCoefficientSlopeIntegratesToTheFunction) {
  const auto phi = ScalingFunction::daubechies(6);
  double previous = 0.0;
  for (const int level : {4, 7, 10, 13}) {
    const double h = std::ldexp(1.0, -level);
    const Eigen::VectorXd values = phi.values(level), slope = phi.values(level, 1);
    double integral = 0.0, error = 0.0;
    for (Eigen::Index n = 1; n < values.size(); ++n) {
      integral += 0.5 * h * (slope[n] + slope[n - 1]);
      error = std::max(error, std::abs(integral - values[n]));
    }
    EXPECT_LT(error, 4 * std::pow(h, 1.0)) << level;
    if (previous > 0.0) {
      EXPECT_LT(error, previous / 4);
    }
    previous = error;
  }
}

// The jumps of the spline's third derivative leave an error of order h^4 (Euler-Maclaurin), h = 2^-6.
TEST(ScalingFunction, IsOrthonormalByQuadrature) {
  for (const auto& [phi, tolerance] :
       {std::pair{ScalingFunction::haar(), 4 * eps}, std::pair{ScalingFunction::daubechies(20), 1e-12},
        std::pair{ScalingFunction::orthonormal_bspline(), std::ldexp(1.0, -24) / 6}}) {
    constexpr int level = 6, one = 1 << level;
    const Eigen::VectorXd v = phi.values(level);
    for (Eigen::Index shift = 0; shift < v.size(); shift += one) {
      const double product = v.head(v.size() - shift).dot(v.tail(v.size() - shift)) / one;
      EXPECT_NEAR(product, shift == 0 ? 1.0 : 0.0, tolerance) << phi.name() << " shift " << shift / one;
    }
  }
}

TEST(ScalingFunction, SplineIsSymmetricAboutTwo) {
  const Eigen::VectorXd v = ScalingFunction::orthonormal_bspline().values(4);
  EXPECT_LT((v - v.reverse()).cwiseAbs().maxCoeff(), 8 * eps);
}

TEST(FourierTransform, IsDeltaAtWholeTurns) {
  for (const auto& phi : all_families())
    for (int k = -40; k <= 40; ++k)
      EXPECT_NEAR(std::abs(phi.fourier_transform(2 * std::numbers::pi * k) - (k == 0 ? 1.0 : 0.0)), 0.0,
                  64 * eps)
          << phi.name() << " k = " << k;
}

TEST(FourierTransform, SatisfiesTheRefinementEquation) {
  for (const auto& phi : all_families()) {
    if (phi.coefficients().size() > 1) continue;  // the orthonormal spline's own filter is infinite
    for (const double xi : {0.3, -1.7, 5.0, 40.0}) {
      std::complex<double> symbol = 0.0;
      for (Eigen::Index l = 0; l < phi.filter().size(); ++l)
        symbol += 0.5 * phi.filter()[l] * std::polar(1.0, -xi * static_cast<double>(l));
      EXPECT_LT(std::abs(phi.fourier_transform(2 * xi) - symbol * phi.fourier_transform(xi)), 512 * eps)
          << phi.name();
    }
  }
}

TEST(FourierTransform, IsTheTransformOfTheValues) {  // trapezoidal sum; the aliasing is below the tolerance
  for (const auto& [phi, tolerance] : {std::pair{ScalingFunction::daubechies(20), 1e-11},
                                       std::pair{ScalingFunction::orthonormal_bspline(), 1e-9},
                                       std::pair{ScalingFunction::daubechies(6), 1e-5}}) {
    constexpr int level = 9;
    const double h = std::ldexp(1.0, -level);
    const Eigen::VectorXd v = phi.values(level);
    for (const double xi : {0.0, 0.5, 2.0, -3.0}) {
      std::complex<double> sum = 0.0;
      for (Eigen::Index n = 0; n < v.size(); ++n)
        sum += h * v[n] * std::polar(1.0, -xi * (phi.support_begin() + h * static_cast<double>(n)));
      EXPECT_LT(std::abs(sum - phi.fourier_transform(xi)), tolerance) << phi.name() << " xi = " << xi;
    }
  }
}

TEST(FourierTransform, OfOrthonormalFunctionsSumsToOneInSquare) {
  for (const auto& phi : {ScalingFunction::daubechies(20), ScalingFunction::orthonormal_bspline()})
    for (const double cycles : {0.0, 0.1, 0.25, 0.5}) {
      double sum = 0.0;
      for (int k = -200; k <= 200; ++k) sum += std::norm(phi.fourier_transform_at_cycles(cycles + k));
      EXPECT_NEAR(sum, 1.0, 512 * eps) << phi.name();
    }
}

TEST(ScalingFunctionErrors, NameTheArgument) {
  EXPECT_THROW(ScalingFunction::daubechies(7), std::invalid_argument);
  EXPECT_THROW(ScalingFunction::haar().values(0, 1), std::invalid_argument);
  EXPECT_THROW(ScalingFunction::daubechies(6).values(-1), std::invalid_argument);
  EXPECT_THROW(ScalingFunction::daubechies(6).values(25), std::invalid_argument);
  EXPECT_THROW(ScalingFunction::daubechies(6).fourier_transform(std::nan("")), std::invalid_argument);
  try {
    ScalingFunction::daubechies(4).values(3, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("derivative of daubechies4 is 1; it must be in 0..0"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace wavebalance::wavelets
