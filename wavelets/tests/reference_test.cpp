#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "constants.hpp"
#include "ten_lectures_table.hpp"
#include "wavebalance/wavelets/connection.hpp"
#include "wavebalance/wavelets/filter.hpp"
#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::wavelets {
namespace {

TEST(PublishedFilters, AreTheHaarAndFourCoefficientClosedForms) {
  EXPECT_EQ(daubechies_filter(2), Eigen::VectorXd::Ones(2));
  const double r = std::sqrt(3.0);
  const Eigen::Vector4d expected((1 + r) / 4, (3 + r) / 4, (3 - r) / 4, (1 - r) / 4);
  EXPECT_LT((daubechies_filter(4) - expected).cwiseAbs().maxCoeff(), 2 * eps);
}

TEST(PublishedFilters, AreTheSixCoefficientClosedForm) {
  const double r = std::sqrt(10.0), s = std::sqrt(5 + 2 * r);
  const Eigen::VectorXd expected = (Eigen::VectorXd(6) << 1 + r + s, 5 + r + 3 * s, 10 - 2 * r + 2 * s,
                                    10 - 2 * r - 2 * s, 5 + r - 3 * s, 1 + r - s)
                                       .finished() /
                                   16.0;
  EXPECT_LT((daubechies_filter(6) - expected).cwiseAbs().maxCoeff(), 4 * eps);
}

TEST(PublishedFilters, AreThoseOfTenLecturesToThePrintedDigits) {
  for (const auto& printed : tables::ten_lectures_filters()) {
    const Eigen::VectorXd h = daubechies_filter(static_cast<int>(printed.size())) / std::numbers::sqrt2;
    for (std::size_t k = 0; k < printed.size(); ++k)
      EXPECT_NEAR(h[static_cast<int>(k)], printed[k], 1e-12) << printed.size() << " coefficients, h_" << k;
  }
}

TEST(PublishedSobolevExponents, OfTwoToTwentyCoefficients) {
  const std::array expected{.5, 1.0, 1.4150, 1.7756, 2.0968, 2.3884, 2.6587, 2.9147, 3.1617, 3.4027};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(sobolev_exponent(daubechies_filter(2 * static_cast<int>(i) + 2)), expected[i], 5.1e-5);
  EXPECT_NEAR(ScalingFunction::orthonormal_bspline().sobolev_exponent(), 3.5, 1e-12);
}

// Daubechies and Lagarias 1992: 2 - log2(1 + sqrt 3) = 0.5500, 1.0878, 1.6179 for 4, 6, 8 coefficients.
TEST(PublishedHoelderExponents, BoundTheComputedLowerBound) {
  EXPECT_NEAR(hoelder_lower_bound(daubechies_filter(4)), 2 - std::log2(1 + std::sqrt(3.0)), 1e-12);
  const double six = hoelder_lower_bound(daubechies_filter(6)),
               eight = hoelder_lower_bound(daubechies_filter(8));
  EXPECT_LT(six, 1.0878 + 5e-5);
  EXPECT_GT(six, 1.0878 - 0.01);
  EXPECT_LT(eight, 1.6179 + 5e-5);
  EXPECT_GT(eight, 1.6179 - 0.02);
}

TEST(PublishedValues, FourCoefficientFunctionAtTheIntegers) {
  const Eigen::VectorXd phi = ScalingFunction::daubechies(4).values(0);
  const double r = std::sqrt(3.0);
  EXPECT_LT((phi - Eigen::Vector4d(0, (1 + r) / 2, (1 - r) / 2, 0)).cwiseAbs().maxCoeff(), 4 * eps);
}

void expect_coefficients(const ConnectionCoefficients& r, std::initializer_list<double> from_zero,
                         double parity) {
  int l = 0;
  for (const double expected : from_zero) {
    EXPECT_NEAR(r(l), expected, 64 * eps * (1 + std::abs(expected))) << "l = " << l;
    EXPECT_NEAR(r(-l), parity * expected, 64 * eps * (1 + std::abs(expected))) << "l = -" << l;
    ++l;
  }
  EXPECT_EQ(r(l), 0.0);
}

TEST(PublishedConnectionCoefficients, SixCoefficients) {
  const auto db6 = ScalingFunction::daubechies(6);
  expect_coefficients(connection_coefficients(db6, db6, 2),
                      {-295.0 / 56, 356.0 / 105, -92.0 / 105, 4.0 / 35, 3.0 / 560}, 1.0);
  expect_coefficients(connection_coefficients(db6, db6, 1),
                      {0.0, -272.0 / 365, 53.0 / 365, -16.0 / 1095, -1.0 / 2920}, -1.0);
}

TEST(PublishedConnectionCoefficients, FourCoefficientsFirstDerivative) {  // Beylkin 1992
  const auto db4 = ScalingFunction::daubechies(4);
  expect_coefficients(connection_coefficients(db4, db4, 1), {0.0, -2.0 / 3, 1.0 / 12}, -1.0);
}

}  // namespace
}  // namespace wavebalance::wavelets
