#include "wavebalance/app/analysis/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace wavebalance::app {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(ObservedOrder, OfAPowerLawIsItsExponent) {
  const std::vector<double> sizes{8, 16, 32, 64};
  std::vector<double> errors;
  for (const double size : sizes) errors.push_back(7.0 * std::pow(size, -3.0));
  EXPECT_NEAR(observed_order(sizes, errors), 3.0, 100 * eps);
  errors[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(observed_order(sizes, errors), std::invalid_argument);
  EXPECT_THROW(observed_order(sizes, std::vector<double>{1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::app
