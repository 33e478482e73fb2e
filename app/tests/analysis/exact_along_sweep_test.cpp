// Source of the stability of a point of a curve. Records: tests/analyses/exact_near_curves_test.py.
#include "wavebalance/app/analysis/sweep.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wavebalance::app {
namespace {

TEST(ExactSolutionsOfASweep, DecideTheVerdictPointByPoint) {
  using solvers::ExactStatus, solvers::ExactAtPoint, solvers::StabilityStatus;
  solvers::CurveStability balance;
  balance.points.resize(4);
  for (auto& point : balance.points) point = {StabilityStatus::converged, 3, 1, 1, 1};
  ExactAlongSweep exact;
  exact.points.resize(4);
  exact.points[0] =
      ExactAtPoint{ExactStatus::converged, 1e-3, 1e-2, solvers::MotionStability{"stable", 0}, 0};
  exact.points[1] = ExactAtPoint{ExactStatus::not_found};
  exact.points[2] = ExactAtPoint{ExactStatus::structural_damping};
  const StabilityAlong along = stability_along(balance, &exact);
  EXPECT_EQ(along.by, (std::vector<std::string>{"phases", "none", "balance", "balance"}));
  EXPECT_EQ(along.points[0].unstable, 0);
  EXPECT_EQ(along.points[1].unstable, -1);
  EXPECT_EQ(along.points[2].unstable, 3);
  EXPECT_EQ(along.status, "not_found");
  EXPECT_EQ(stability_along(balance, nullptr).points[0].unstable, 3);
}

}  // namespace
}  // namespace wavebalance::app
