#include "wavebalance/solvers/stability/curve_stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "constants.hpp"
#include "support/jl14_bar.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"

namespace wavebalance::solvers {
namespace {

using Type = SpecialPointType;

/// A curve with its stability.
struct Traced {
  FrequencySweep curve;
  CurveStability stability;

  std::vector<SpecialPoint> of(Type type) const {
    std::vector<SpecialPoint> found;
    for (const SpecialPoint& point : stability.special_points)
      if (point.type == type) found.push_back(point);
    return found;
  }
};

Traced trace(const LinearStructure& structure, const ContactLaws& laws, double from, double to, int functions,
             int points) {
  CondensedProblem problem(testing::fourier_pair(functions, points), structure, testing::cosine_load());
  FrequencySweepOptions options;
  options.from = from;
  options.to = to;
  options.keep_unknowns = true;
  Traced traced;
  traced.curve = frequency_sweep(problem, laws, options);
  traced.stability = curve_stability(problem, laws, traced.curve, ContactDynamics(structure));
  return traced;
}

Traced trace_case_2(double beta, int functions, int points) {
  return trace(testing::jl14_bar(25, beta), testing::jl14_case_2.law, 1100.0, 1700.0, functions, points);
}

// Between the first and the second change of the count.
TEST(CurveStability, IsLostBetweenTheFoldsOfCase2AndNowhereElse) {
  const Traced traced = trace_case_2(testing::jl14_case_2.beta, 63, 512);
  ASSERT_EQ(traced.stability.points.size(), traced.curve.points.size());
  std::vector<int> counts;
  for (const PointStability& point : traced.stability.points)
    if (point.status == StabilityStatus::converged && (counts.empty() || counts.back() != point.unstable))
      counts.push_back(point.unstable);
  EXPECT_EQ(counts, (std::vector<int>{0, 1, 0}));
}

TEST(CurveStability, FindsTheFoldsOfTheSamplesAtAMultiplierOf1) {
  const Traced traced = trace_case_2(testing::jl14_case_2.beta, 63, 1024);
  const auto folds = traced.of(Type::fold);
  ASSERT_EQ(folds.size(), 2u);
  ASSERT_EQ(traced.curve.turning_points.size(), 2u);
  for (std::size_t i = 0; i < folds.size(); ++i) {
    EXPECT_TRUE(folds[i].located);
    EXPECT_NEAR(folds[i].frequency, traced.curve.turning_points[i].frequency, 0.02);
    EXPECT_LE(folds[i].bracket, 1e-5);
    EXPECT_LE(std::abs(folds[i].multiplier - 1.0), 1e-5);
    EXPECT_NEAR(folds[i].max_displacement, traced.curve.turning_points[i].max_displacement, 2e-5);
  }
  EXPECT_TRUE(traced.of(Type::branch).empty());
  EXPECT_TRUE(traced.of(Type::period_doubling).empty());
  EXPECT_TRUE(traced.of(Type::neimark_sacker).empty());
}

// The contact-free motion reaches the gap there, in closed form.
TEST(CurveStability, FindsGrazingWhereTheFreeMotionReachesTheGap) {
  const testing::LinearContact stop{10.0, 0.1};
  const Traced traced = trace(testing::unit_oscillator(0.1, 0.8), stop, 3.2 / two_pi, 2.1 / two_pi, 31, 1024);
  const auto grazings = traced.of(Type::grazing);
  ASSERT_EQ(grazings.size(), 1u);
  EXPECT_NEAR(two_pi * grazings[0].frequency, 2.999062609918, 1e-5);
  EXPECT_NEAR(grazings[0].max_displacement, stop.start, 1e-6);
  EXPECT_TRUE(std::isnan(grazings[0].multiplier.real()));
}

// References: event-driven shooting made independently of this code.
TEST(CurveStability, FindsThePeriodDoublingsOfAnOscillatorWithAStop) {
  const Traced traced = trace(testing::unit_oscillator(0.1, 0.8), testing::LinearContact{10.0, 0.1},
                              2.1 / two_pi, 2.99 / two_pi, 63, 1024);
  const auto doublings = traced.of(Type::period_doubling);
  ASSERT_EQ(doublings.size(), 2u);
  EXPECT_NEAR(two_pi * doublings[0].frequency, 2.206199894019, 1e-4);
  EXPECT_NEAR(two_pi * doublings[1].frequency, 2.973736781998, 1e-4);
  for (const SpecialPoint& point : doublings) EXPECT_LE(std::abs(point.multiplier + 1.0), 1e-4);
}

TEST(CurveStability, FindsTheNeimarkSackerPointsOfTheLightlyDampedBar) {
  const auto points = trace_case_2(5e-7, 63, 1024).of(Type::neimark_sacker);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].frequency, 1312.442975, 0.5);
  EXPECT_NEAR(points[1].frequency, 1378.541283, 0.5);
  EXPECT_LE(std::abs(points[0].multiplier - std::complex<double>(0.95655432, 0.29155416)), 3e-3);
  EXPECT_LE(std::abs(points[1].multiplier - std::complex<double>(0.93463566, 0.35560678)), 3e-3);
}

TEST(CurveStability, FindsThePeriodDoublingsOfTheBarWithASmallGap) {
  testing::ExponentialLaw law = testing::jl14_case_2.law;
  law.start = 1e-4;
  const auto points =
      trace(testing::jl14_bar(25, 1.25e-6), law, 2800.0, 3050.0, 63, 1024).of(Type::period_doubling);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].frequency, 2840.476702, 0.5);
  EXPECT_NEAR(points[1].frequency, 2988.746353, 0.5);
}

/// Two masses of 1 with springs of 1 between them and to the ground, the second driven, C = 0.03 K.
LinearStructure two_masses() {
  Eigen::Matrix2d stiffness;
  stiffness << 1.0, -1.0, -1.0, 2.0;
  LinearStructure structure;
  structure.mass = Eigen::MatrixXd::Identity(2, 2).sparseView();
  structure.stiffness = Eigen::MatrixXd(stiffness).sparseView();
  structure.damping = 0.03 * structure.stiffness;
  structure.contact_directions = contact_rows({0}, 2);
  structure.load = Eigen::Vector2d(0.0, 0.1);
  return structure;
}

// Contact begins at 1e-6 from the Neimark-Sacker point, with a kink of the curve between them. References:
// the grazing is in closed form, the other by event-driven shooting.
TEST(CurveStability, TellsAGrazingFromANeimarkSackerPointBesideItFromAnyStart) {
  for (const double from : {0.0945, 0.0950, 0.0955, 0.0960, 0.0965, 0.0970, 0.0975}) {
    const Traced traced = trace(two_masses(), testing::LinearContact{100.0, 1.0}, from, 0.092, 63, 1024);
    const auto grazings = traced.of(Type::grazing), torus = traced.of(Type::neimark_sacker);
    ASSERT_EQ(grazings.size(), 1u) << from;
    ASSERT_EQ(torus.size(), 1u) << from;
    EXPECT_TRUE(grazings[0].located && torus[0].located) << from;
    EXPECT_NEAR(two_pi * grazings[0].frequency, 0.5818996390, 1e-7) << from;
    EXPECT_NEAR(two_pi * torus[0].frequency, 0.5819006504, 1e-7) << from;
  }
}

TEST(CurveStability, OfAnUndampedStructureIsNotKnown) {
  const Traced traced =
      trace(testing::unit_oscillator(0.0, 0.8), testing::LinearContact{10.0, 0.1}, 0.3, 0.4, 15, 64);
  EXPECT_EQ(traced.stability.status(), StabilityStatus::undamped);
  for (const PointStability& point : traced.stability.points) EXPECT_EQ(point.unstable, -1);
}

TEST(CurveStability, NeedsTheUnknownsOfTheCurve) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  const testing::LinearContact stop{10.0, 0.1};
  CondensedProblem problem(testing::fourier_pair(15, 64), structure, testing::cosine_load());
  FrequencySweepOptions options;
  options.from = 0.3;
  options.to = 0.4;
  const FrequencySweep curve = frequency_sweep(problem, stop, options);
  try {
    curve_stability(problem, stop, curve, ContactDynamics(structure));
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("keep_unknowns"), std::string::npos) << error.what();
  }
}

TEST(CurveStability, StopsWhenItsObserverSaysSo) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  const testing::LinearContact stop{10.0, 0.1};
  CondensedProblem problem(testing::fourier_pair(15, 64), structure, testing::cosine_load());
  FrequencySweepOptions sweep;
  sweep.from = 0.3;
  sweep.to = 0.4;
  sweep.keep_unknowns = true;
  const FrequencySweep curve = frequency_sweep(problem, stop, sweep);
  CurveStabilityOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 3; };
  const CurveStability stability = curve_stability(problem, stop, curve, ContactDynamics(structure), options);
  EXPECT_TRUE(stability.cancelled);
  EXPECT_EQ(stability.points.size(), 3u);
}

}  // namespace
}  // namespace wavebalance::solvers
