#include <gtest/gtest.h>

#include <cmath>

#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::app {
namespace {

TEST(ErrorMeasures, TakeOnePartOrTheLargerAndKnowNothingWhereAPartIsMissing) {
  EXPECT_EQ(weighed_error(ErrorMeasure::displacement, 1e-3, 1e-2), 1e-3);
  EXPECT_EQ(weighed_error(ErrorMeasure::force, 1e-3, 1e-2), 1e-2);
  EXPECT_EQ(weighed_error(ErrorMeasure::both, 1e-3, 1e-2), 1e-2);
  EXPECT_EQ(weighed_error(ErrorMeasure::both, 1e-1, 1e-2), 1e-1);
  EXPECT_EQ(weighed_error(ErrorMeasure::displacement, 1e-3, solvers::missing), 1e-3);
  EXPECT_TRUE(std::isnan(weighed_error(ErrorMeasure::both, 1e-3, solvers::missing)));
  EXPECT_TRUE(std::isnan(weighed_error(ErrorMeasure::both, solvers::missing, 1e-3)));
}

}  // namespace
}  // namespace wavebalance::app
