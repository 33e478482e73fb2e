#include "branches/branch_arrival.hpp"

#include <gtest/gtest.h>

namespace wavebalance::solvers {
namespace {

CurvePoint at(double first, double second, double frequency) {
  CurvePoint point;
  point.displacement = Eigen::Vector2d(first, second);
  point.parameter = frequency;
  return point;
}

// A curve along which the first unknown grows by 0.1 per step and the frequency by 0.1 Hz, far from zero.
FrequencySweep straight_curve() {
  FrequencySweep curve;
  for (int i = -5; i <= 5; ++i) {
    SweepPoint point;
    point.unknown = Eigen::Vector2d(3.0 + 0.1 * i, 2.0);
    point.frequency = 10.0 + 0.1 * i;
    curve.points.push_back(point);
  }
  return curve;
}

TEST(BranchArrival, AFirstPointAlongTheCurveLiesOnIt) {
  const FrequencySweep curve = straight_curve();
  const CurvePoint origin = at(3.0, 2.0, 10.0);
  EXPECT_TRUE(lies_on(curve, origin, at(3.05, 2.0, 10.05), {}));
  EXPECT_TRUE(lies_on(curve, origin, at(2.95, 2.0, 9.95), {}));
}

// Each differs from the curve only in one unknown or in the frequency.
TEST(BranchArrival, AFirstPointThatLeavesTheCurveDoesNotLieOnIt) {
  const FrequencySweep curve = straight_curve();
  const CurvePoint origin = at(3.0, 2.0, 10.0);
  EXPECT_FALSE(lies_on(curve, origin, at(3.0, 2.05, 10.0), {}));
  EXPECT_FALSE(lies_on(curve, origin, at(3.05, 2.0, 9.95), {}));
  EXPECT_FALSE(lies_on(curve, origin, at(3.05, 2.0, 10.0), {}));
  EXPECT_FALSE(lies_on(curve, origin, at(3.0, 2.0, 10.05), {}));
}

}  // namespace
}  // namespace wavebalance::solvers
