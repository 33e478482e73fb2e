#include "multiplier_strategies.hpp"

#include <gtest/gtest.h>

namespace wavebalance::ll10 {
namespace {

TEST(MultiplierStrategies, MeasureConstraintsAsPowellDoes) {
  MultipliersOnly multipliers(2, 10.0);
  const std::vector<double> g{0.5, -0.2};
  const double h = -0.1;
  const auto first = multipliers.update(g, h);
  EXPECT_DOUBLE_EQ(first.inequality_measure, 0.5);
  EXPECT_DOUBLE_EQ(first.equality_measure, 0.1);
  EXPECT_FALSE(first.converged);
  std::vector<double> force(2), tangent(2);
  multipliers.inequality_force(g, force, tangent);
  EXPECT_EQ(force, (std::vector<double>{5.0, 0.0}));
  EXPECT_EQ(tangent, (std::vector<double>{0.0, 0.0}));
  EXPECT_TRUE(multipliers.update(std::vector<double>{0.0, -0.2}, 0.0).converged);
  PenaltiesOnly penalties(2, 10.0);
  penalties.inequality_force(g, force, tangent);
  EXPECT_EQ(force, (std::vector<double>{5.0, 0.0}));
  EXPECT_EQ(tangent, (std::vector<double>{10.0, 0.0}));
  penalties.update(g, h);
  EXPECT_DOUBLE_EQ(penalties.equality_penalty(), 100.0);
}

}  // namespace
}  // namespace wavebalance::ll10
