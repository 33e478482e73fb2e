#include <gtest/gtest.h>

#include "wavebalance/app/compare/solve_point.hpp"

namespace wavebalance::app {
namespace {

SolvePoint point(double seconds, double error, bool converged = true) {
  SolvePoint one;
  one.seconds = seconds;
  one.error = error;
  one.converged = converged;
  return one;
}

TEST(ParetoFront, HoldsThePointsThatNoOtherBeatsInBothAndNeverOneThatHasNotConverged) {
  std::vector<SolvePoint> points{point(1.0, 1e-1), point(2.0, 1e-2),        point(3.0, 2e-2),
                                 point(4.0, 1e-3), point(0.5, 1e-9, false), point(4.0, 2e-3)};
  mark_front(points);
  std::vector<bool> front;
  for (const SolvePoint& one : points) front.push_back(one.on_front);
  EXPECT_EQ(front, (std::vector<bool>{true, true, false, true, false, false}));
}

TEST(ParetoFront, KeepsEqualPointsBoth) {
  std::vector<SolvePoint> points{point(1.0, 1e-3), point(1.0, 1e-3)};
  mark_front(points);
  EXPECT_TRUE(points[0].on_front && points[1].on_front);
}

TEST(ParetoFront, IsAnEnvelopeByRisingTimeWithFallingError) {
  const auto front = envelope({point(4.0, 1e-3), point(1.0, 1e-1), point(3.0, 2e-2), point(2.0, 1e-2)});
  ASSERT_EQ(front.size(), 3u);
  for (std::size_t i = 1; i < front.size(); ++i) {
    EXPECT_GT(front[i].seconds, front[i - 1].seconds);
    EXPECT_LT(front[i].error, front[i - 1].error);
  }
}

TEST(TimeLimit, AllowsTheNextSizeWhileItIsExpectedWithinTheLimit) {
  TimeLimit limit(1.0);
  EXPECT_TRUE(limit.allows());
  limit.took(0.01);
  EXPECT_TRUE(limit.allows());
  limit.took(0.08);  // cubic: 0.64 s next
  EXPECT_TRUE(limit.allows());
  limit.took(0.64);
  EXPECT_FALSE(limit.allows());
}

TEST(TimeLimit, ExpectsProportionalGrowthAtLeastAndCubicGrowthAtMost) {
  TimeLimit shrinking(1.0), jumping(1.0);
  shrinking.took(5.0);
  shrinking.took(0.6);
  EXPECT_FALSE(shrinking.allows());
  jumping.took(1e-6);
  jumping.took(0.1);
  EXPECT_TRUE(jumping.allows());
}

TEST(LeastSeconds, CallsAsOftenAsAskedUnlessTheFirstCallTakesTooLong) {
  int calls = 0;
  EXPECT_GE(least_seconds([&] { ++calls; }, {.budget = 0.0, .least = 3, .max_seconds = 1.0}), 0.0);
  EXPECT_EQ(calls, 3);
  calls = 0;
  least_seconds([&] { ++calls; }, {.budget = 0.0, .least = 3, .max_seconds = 0.0});
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace wavebalance::app
