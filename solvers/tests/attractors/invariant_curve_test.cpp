#include "wavebalance/solvers/attractors/invariant_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace wavebalance::solvers {
namespace {

constexpr double turn = 2.0 * std::numbers::pi, tolerance = 1e-6;

// Points of a curve whose harmonic of so many turns is the strongest.
Eigen::MatrixXd turned(double rotation, int strongest, int count) {
  Eigen::MatrixXd points(2, count);
  for (int n = 0; n < count; ++n) {
    const double angle = turn * rotation * n + 0.4;
    points(0, n) = 3.0 + std::cos(strongest * angle) + 0.2 * std::cos(angle) + 0.05 * std::sin(5.0 * angle);
    points(1, n) = std::sin(strongest * angle) - 0.1 * std::sin(angle);
  }
  return points;
}

TEST(InvariantCurve, FindsTheRotationWhicheverHarmonicIsStrongest) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (const int strongest : {1, 2, 3}) {
    const InvariantCurve curve = invariant_curve(turned(golden, strongest, 512), tolerance);
    EXPECT_NEAR(curve.rotation, 1.0 - golden, 1e-12) << strongest;  // passed the other way round
    EXPECT_LT(curve.residual, 1e-8) << strongest;
    EXPECT_NEAR(curve.coefficients(0, 0), 3.0, 1e-10) << strongest;
  }
}

TEST(InvariantCurve, PassesThroughThePoints) {
  const Eigen::MatrixXd points = turned(0.137, 1, 512);
  const InvariantCurve curve = invariant_curve(points, tolerance);
  double nearest = 1.0;
  for (int k = 0; k < 2000; ++k) nearest = std::min(nearest, (curve.at(k / 2000.0) - points.col(17)).norm());
  EXPECT_LT(nearest, 5e-3);
}

TEST(InvariantCurve, NoCurveIsFoundInChaosOrRest) {
  Eigen::MatrixXd chaos(1, 1024);
  double x = 0.3;
  for (Eigen::Index n = 0; n < chaos.cols(); ++n) chaos(0, n) = x = 3.9 * x * (1.0 - x);
  EXPECT_GT(invariant_curve(chaos, tolerance).residual, 0.3);
  EXPECT_TRUE(std::isinf(invariant_curve(Eigen::MatrixXd::Ones(2, 256), tolerance).residual));
  EXPECT_TRUE(std::isinf(invariant_curve(turned(0.137, 1, 40), tolerance).residual));  // too few points
}

}  // namespace
}  // namespace wavebalance::solvers
