#include <gtest/gtest.h>

#include "uniform_bar.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem {
namespace {

EigenmodesResult first_modes(const BarOptions& options, int count) {
  const Matrices matrices = bar(options);
  return eigenmodes(matrices.stiffness, matrices.mass, count);
}

// The rod of Laxalde & Legrand 2010, section 4.
BarOptions rod(double lumped_fraction) {
  BarOptions options{.youngs_modulus = 2.1e11,
                     .density = 7800,
                     .area = 0.03 * 0.03,
                     .elements = 20,
                     .lumped_fraction = lumped_fraction};
  return options;
}

TEST(PublishedBar, HasTheNaturalFrequenciesOfTwentyFiveElements) {
  const EigenmodesResult found = first_modes(published_bar(), 3);
  EXPECT_NEAR(found.frequencies_hz[0], 1273.147, 5e-4);
  EXPECT_NEAR(found.frequencies_hz[1], 3824.469, 5e-4);
  EXPECT_NEAR(found.frequencies_hz[2], 6390.893, 5e-4);
}

TEST(PublishedRod, HasTheNaturalFrequenciesOfTwentyElements) {
  const EigenmodesResult found = first_modes(rod(0.0), 2);
  EXPECT_NEAR(found.frequencies_hz[0], 1297.5197, 5e-5);
  EXPECT_NEAR(found.omega[1] / found.omega[0], 3.00617, 5e-6);
}

TEST(PublishedRod, IsNearlyHarmonicWithHalfTheMassLumped) {
  const EigenmodesResult found = first_modes(rod(0.5), 2);
  EXPECT_NEAR(found.omega[1] / found.omega[0], 3.0000, 5e-5);
}

}  // namespace
}  // namespace wavebalance::fem
