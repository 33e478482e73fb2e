#include "curve_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace wavebalance::jl14 {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Eigen::VectorXd sampled(int n, double (*f)(double)) {
  return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index i) { return f(static_cast<double>(i) / n); });
}

double cosine(double t) { return std::cos(2 * std::numbers::pi * t); }

TEST(TotalVariation, OfACosineIsTwiceItsRange) {
  EXPECT_NEAR(total_variation(sampled(64, cosine)), 4.0, 64 * eps);
}

TEST(TotalVariation, ClosesThePeriod) {
  EXPECT_DOUBLE_EQ(total_variation(Eigen::Vector3d(0.0, 1.0, 3.0)), 1.0 + 2.0 + 3.0);
  EXPECT_EQ(total_variation(Eigen::VectorXd::Constant(1, 5.0)), 0.0);
}

TEST(ExcessVariation, MeasuresRippleAndIgnoresScale) {
  const Eigen::VectorXd reference = sampled(256, cosine);
  EXPECT_NEAR(excess_variation(reference, reference), 0.0, 256 * eps);
  const Eigen::VectorXd ripple =
      reference + sampled(256, [](double t) { return 0.1 * std::cos(64 * std::numbers::pi * t); });
  EXPECT_GT(excess_variation(ripple, reference), 0.5);
  EXPECT_NEAR(excess_variation(3.0 * ripple, 3.0 * reference), excess_variation(ripple, reference), 1e-13);
}

TEST(LargestChange, GoesRoundThePeriod) {
  const Eigen::Vector4d values(0.0, 1.0, 2.0, 7.0);
  EXPECT_EQ(largest_change(values, 1), 7.0);  // from the last to the first
  EXPECT_EQ(largest_change(values, 2), 6.0);
}

TEST(WholeCells, KeepsCellsThatLieInsideAltogether) {
  Mask where(6);
  where << true, true, true, false, true, true;
  const Mask found = whole_cells(where, 3);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(found[i], i < 2 || i > 3) << i;
  EXPECT_THROW(whole_cells(where, 4), std::invalid_argument);
}

TEST(BestConstants, AreTheMeansOfTheCells) {
  EXPECT_EQ(best_constants(Eigen::Vector4d(1.0, 3.0, 5.0, 9.0), 2), Eigen::Vector4d(2.0, 2.0, 7.0, 7.0));
  EXPECT_THROW(best_constants(Eigen::Vector4d::Zero(), 3), std::invalid_argument);
}

TEST(CentralDifferences, AreOfSecondOrder) {
  const double period = 0.5, rate = 2.0 * std::numbers::pi / period;
  const auto error = [&](int points) {
    const Eigen::VectorXd found = central_differences(sampled(1024, cosine), points, period);
    const Eigen::VectorXd sine = sampled(points, [](double t) { return std::sin(2 * std::numbers::pi * t); });
    return (found + rate * sine).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(error(64) / error(128), 4.0, 0.02);
  EXPECT_THROW(central_differences(sampled(1024, cosine), 100, period), std::invalid_argument);
}

TEST(CoefficientsNeeded, LeavesOutTheSmallest) {
  const Eigen::Vector4d coefficients(3.0, 0.0, -4.0, 0.1);
  EXPECT_EQ(coefficients_needed(coefficients, 0.0), 3);
  EXPECT_EQ(coefficients_needed(coefficients, 0.03), 2);
  EXPECT_EQ(coefficients_needed(coefficients, 0.61), 1);
  EXPECT_EQ(coefficients_needed(coefficients, 1.0), 0);
}

TEST(Select, KeepsTheOrder) {
  Eigen::Array<bool, Eigen::Dynamic, 1> where(4);
  where << true, false, false, true;
  EXPECT_EQ(select(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), where), Eigen::Vector2d(1.0, 4.0));
}

TEST(RelativeMeanError, WeighsSpikesLess) {
  EXPECT_DOUBLE_EQ(relative_mean_error(Eigen::Vector2d(2.0, -1.0), Eigen::Vector2d(1.0, -1.0)), 0.5);
}

TEST(CellMidpoints, TakesTheMiddleSample) {
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(8, 0.0, 7.0);
  EXPECT_EQ(cell_midpoints(values, 2), Eigen::Vector2d(2.0, 6.0));
  EXPECT_THROW(cell_midpoints(values, 8), std::invalid_argument);
  EXPECT_THROW(cell_midpoints(values, 0), std::invalid_argument);
}

TEST(SignChanges, SkipsZerosAndDoesNotJoinTheEnds) {
  Eigen::VectorXd values(6);
  values << 1.0, 0.0, -2.0, -1.0, 3.0, 0.0;
  EXPECT_EQ(sign_changes(values), 2);
}

TEST(RefinementGain, FallsByFourForASmoothFunction) {
  const auto polygon = [](int intervals) {
    return Eigen::VectorXd::LinSpaced(intervals + 1, 0.0, 1.0).array().square().matrix().eval();
  };
  const double coarse = refinement_gain(polygon(8), polygon(16));
  EXPECT_NEAR(coarse, 1.0 / 256.0, 4 * eps);  // h^2 / 4 for t^2
  EXPECT_NEAR(refinement_gain(polygon(16), polygon(32)), coarse / 4.0, 4 * eps);
}

}  // namespace
}  // namespace wavebalance::jl14
