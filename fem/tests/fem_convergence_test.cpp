#include <gtest/gtest.h>

#include "uniform_bar.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem {
namespace {

double relative_error(int elements, double lumped_fraction, int mode) {
  BarOptions options{.elements = elements, .lumped_fraction = lumped_fraction};
  const Matrices matrices = bar(options);
  const EigenmodesResult found = eigenmodes(matrices.stiffness, matrices.mass, mode);
  return found.omega[mode - 1] / continuous_omega(options, mode) - 1.0;
}

double observed_order(double lumped_fraction, int mode) {
  return std::log2(relative_error(20, lumped_fraction, mode) / relative_error(40, lumped_fraction, mode));
}

TEST(BarFrequencies, ConvergeFromAboveWithOrderTwoWithConsistentMass) {
  for (int mode : {1, 2, 3}) {
    EXPECT_GT(relative_error(20, 0.0, mode), 0.0);
    EXPECT_NEAR(observed_order(0.0, mode), 2.0, 0.02);
  }
}

TEST(BarFrequencies, ConvergeFromBelowWithOrderTwoWithLumpedMass) {
  for (int mode : {1, 2, 3}) {
    EXPECT_LT(relative_error(20, 1.0, mode), 0.0);
    EXPECT_NEAR(observed_order(1.0, mode), 2.0, 0.02);
  }
}

TEST(BarFrequencies, ConvergeWithOrderFourWithHalfTheMassLumped) {
  for (int mode : {1, 2, 3}) EXPECT_NEAR(observed_order(0.5, mode), 4.0, 0.05);
}

}  // namespace
}  // namespace wavebalance::fem
