#include <gtest/gtest.h>

#include <limits>

#include "daubechies_reference.hpp"

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

class DaubechiesLength : public ::testing::TestWithParam<int> {
 protected:
  wavebalance::extremes::FilterAccuracy accuracy_ = wavebalance::extremes::filter_accuracy(GetParam());
};

// The filter is found in extended precision: what is left is the rounding of each coefficient.
TEST_P(DaubechiesLength, HasEveryCoefficientRightToOneRounding) {
  EXPECT_LE(accuracy_.relative_error, 0.5 * eps);
}

TEST_P(DaubechiesLength, IsOrthogonalToTheRoundingOfItsCoefficients) {
  EXPECT_LE(accuracy_.orthogonality, 2.0 * eps);  // sum |p_l p_l+2m| <= 2, each factor off by eps / 2
}

TEST_P(DaubechiesLength, HasValuesAtTheIntegersWithinTheConditionOfTheirEquations) {
  EXPECT_LE(accuracy_.values_error, 4.0 * eps * std::max(1.0, accuracy_.values_condition));
}

INSTANTIATE_TEST_SUITE_P(All, DaubechiesLength, ::testing::Range(2, 41, 2));

}  // namespace
