#include "wavebalance/wavelets/bspline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "constants.hpp"

namespace wavebalance::wavelets {
namespace {

TEST(BsplineValues, AreThePublishedCubicPieces) {  // [JL14, eq. (29)]
  for (const double f : {0.0, 0.125, 0.3, 0.5, 0.75, 0.999}) {
    const Eigen::VectorXd values = bspline_values(3, f);
    const auto cube = [](double x) { return x * x * x; };
    const double t1 = f + 1, t2 = f + 2, t3 = f + 3;
    EXPECT_NEAR(values[0], cube(f) / 6, 4 * eps);
    EXPECT_NEAR(values[1], -cube(t1) / 2 + 2 * t1 * t1 - 2 * t1 + 2.0 / 3, 16 * eps);
    EXPECT_NEAR(values[2], cube(t2) / 2 - 4 * t2 * t2 + 10 * t2 - 22.0 / 3, 64 * eps);
    EXPECT_NEAR(values[3], -cube(t3) / 6 + 2 * t3 * t3 - 8 * t3 + 32.0 / 3, 128 * eps);
  }
}

TEST(BsplineValues, DerivativesAreThoseOfThePieces) {
  const double f = 0.3;
  const Eigen::Vector4d slope(f * f / 2, -1.5 * 1.3 * 1.3 + 4 * 1.3 - 2, 1.5 * 2.3 * 2.3 - 8 * 2.3 + 10,
                              -0.5 * 3.3 * 3.3 + 4 * 3.3 - 8);
  EXPECT_LT((bspline_values(3, f, 1) - slope).cwiseAbs().maxCoeff(), 32 * eps);
  const Eigen::Vector4d curvature(f, -3 * 1.3 + 4, 3 * 2.3 - 8, -3.3 + 4);
  EXPECT_LT((bspline_values(3, f, 2) - curvature).cwiseAbs().maxCoeff(), 32 * eps);
  EXPECT_LT((bspline_values(3, f, 3) - Eigen::Vector4d(1, -3, 3, -1)).cwiseAbs().maxCoeff(), 8 * eps);
}

TEST(BsplineValues, SumToOneAndTheirDerivativesToZero) {
  for (int degree = 0; degree <= 8; ++degree)
    for (const double f : {0.0, 0.1, 0.77}) {
      EXPECT_NEAR(bspline_values(degree, f).sum(), 1.0, 8 * eps);
      if (degree > 0) {
        EXPECT_NEAR(bspline_values(degree, f, 1).sum(), 0.0, 8 * eps);
      }
    }
}

TEST(BsplineValues, RejectWhatDoesNotExist) {
  EXPECT_THROW(bspline_values(3, 0.5, 4), std::invalid_argument);
  EXPECT_THROW(bspline_values(3, 0.5, -1), std::invalid_argument);
  EXPECT_THROW(bspline_values(3, 1.0), std::invalid_argument);
  EXPECT_THROW(bspline_values(3, -0.1), std::invalid_argument);
  EXPECT_THROW(bspline_values(3, std::nan("")), std::invalid_argument);
}

TEST(CubicGramSymbol, IsTheTransformOfTheSeventhDegreeBspline) {
  const Eigen::VectorXd b7 = bspline_values(7, 0.0);  // B_7(0..7), symmetric about 4
  for (const double xi : {0.0, 0.4, 1.0, 2.5, 3.0}) {
    double sum = b7[4];
    for (int k = 1; k <= 3; ++k) sum += 2 * b7[4 + k] * std::cos(k * xi);
    EXPECT_NEAR(cubic_gram_symbol(std::cos(xi)), sum, 8 * eps);
  }
}

// 1/pi times the integral over (0, pi) of [JL14, eq. (30)], by five Gauss points in each of 200 cells. The
// error of the rule is below rounding for cos(50 xi).
double published_integral(int k) {
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3,
               outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double inner_weight = (322 + 13 * std::sqrt(70.0)) / 900,
               outer_weight = (322 - 13 * std::sqrt(70.0)) / 900;
  const double nodes[] = {-outer, -inner, 0, inner, outer};
  const double weights[] = {outer_weight, inner_weight, 128.0 / 225, inner_weight, outer_weight};
  constexpr int cells = 200;
  double sum = 0;
  for (int cell = 0; cell < cells; ++cell)
    for (int i = 0; i < 5; ++i) {
      const double xi = std::numbers::pi * (cell + 0.5 + 0.5 * nodes[i]) / cells;
      sum += weights[i] * std::cos(k * xi) / std::sqrt(cubic_gram_symbol(std::cos(xi)));
    }
  return sum / (2 * cells);
}

TEST(OrthonormalCubicCoefficients, AreThePublishedIntegrals) {  // [JL14, eq. (30)]
  const Eigen::VectorXd c = orthonormal_cubic_coefficients(50);
  for (int k = 0; k <= 50; ++k) EXPECT_NEAR(c[k], published_integral(k), 32 * eps) << k;
}

TEST(OrthonormalCubicCoefficients, SumToOne) {
  const Eigen::VectorXd c = orthonormal_cubic_coefficients(50);
  EXPECT_NEAR(c[0] + 2 * c.tail(50).sum(), 1.0, 64 * eps);
}

// The singularity of 1/sqrt(p_3) at its zero nearest to the unit circle, -0.53528 in exp(i xi), gives
// c_k ~ k^{-1/2} (-0.53528)^k, so that c_{k+1}/c_k sqrt((k+1)/k) tends to it at the rate 1/k^2.
TEST(OrthonormalCubicCoefficients, DecayGeometrically) {
  const Eigen::VectorXd c = orthonormal_cubic_coefficients(30);
  for (int k = 12; k <= 24; ++k)
    EXPECT_NEAR(c[k + 1] / c[k] * std::sqrt((k + 1.0) / k), -0.53528, 0.5 / (k * k)) << k;
}

TEST(OrthonormalCubicCoefficients, RejectAnIndexOutOfRange) {
  EXPECT_THROW(orthonormal_cubic_coefficients(-1), std::invalid_argument);
  EXPECT_THROW(orthonormal_cubic_coefficients(101), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::wavelets
