// Status of a sweep whose isolas were followed. Their values: tests/analyses/isolas_test.py.
#include <gtest/gtest.h>

#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::app {
namespace {

TEST(Isolas, ThatEndOnTheCurveSayThatAPartWasMissed) {
  Sweep sweep;
  sweep.curve.status = solvers::SweepStatus::reached_end;
  EXPECT_TRUE(sweep.converged());
  sweep.isolas.emplace_back().origin = {0.18, 0, false};
  EXPECT_EQ(sweep.status(), "reached_end");
  sweep.isolas.back().origin.meets_known = true;
  EXPECT_EQ(sweep.status(), "missed_part");
  EXPECT_FALSE(sweep.converged());
}

}  // namespace
}  // namespace wavebalance::app
