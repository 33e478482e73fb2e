#include "wavebalance/wavelets/filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "constants.hpp"

namespace wavebalance::wavelets {
namespace {

class DaubechiesFilter : public ::testing::TestWithParam<int> {
 protected:
  int length() const { return GetParam(); }
  int zeros() const { return GetParam() / 2; }
  Eigen::VectorXd filter_ = daubechies_filter(GetParam());
};

TEST_P(DaubechiesFilter, SumsToTwo) {
  ASSERT_EQ(filter_.size(), length());
  EXPECT_NEAR(filter_.sum(), 2.0, 4 * eps);
}

TEST_P(DaubechiesFilter, IsOrthonormalAtEvenShifts) {
  for (int shift = 0; shift < length(); shift += 2) {
    const double product = filter_.head(length() - shift).dot(filter_.tail(length() - shift));
    EXPECT_NEAR(product, shift == 0 ? 2.0 : 0.0, 8 * eps) << "shift " << shift;
  }
}

TEST_P(DaubechiesFilter, HasVanishingAlternatingMoments) {
  for (int order = 0; order < zeros(); ++order) {
    long double moment = 0, scale = 0;
    for (int l = 0; l < length(); ++l) {
      const long double term =
          (l % 2 == 0 ? 1 : -1) * filter_[l] * std::pow(static_cast<long double>(l), order);
      moment += term;
      scale += std::abs(term);
    }
    EXPECT_LT(std::abs(moment), 2 * eps * scale) << "order " << order;
  }
  EXPECT_EQ(zeros_at_pi(filter_), zeros());
}

// Jensen's formula: log|p_0| is the mean of log|p| over the unit circle if and only if no zero lies inside,
// and |p|^2 = 4 cos^{2N}(xi/2) P(sin^2(xi/2)) is known. Any other choice of the roots has a smaller |p_0|.
TEST_P(DaubechiesFilter, HasMinimumPhase) {
  constexpr int points = 4096;
  double mean = 0.0;
  for (int i = 0; i < points; ++i) {
    const double y = std::pow(std::sin(std::numbers::pi * i / points), 2);
    double binomial = 1.0, polynomial = 1.0, power = 1.0;
    for (int k = 1; k < zeros(); ++k) {
      binomial *= static_cast<double>(zeros() - 1 + k) / k;
      power *= y;
      polynomial += binomial * power;
    }
    mean += 0.5 * std::log(polynomial) / points;
  }
  const double expected = (1 - zeros()) * std::numbers::ln2 + mean;
  EXPECT_NEAR(std::log(filter_[0]), expected, 100 * eps * (1 + std::abs(expected)));
}

INSTANTIATE_TEST_SUITE_P(AllLengths, DaubechiesFilter, ::testing::Range(2, 41, 2));

TEST(DaubechiesFilterErrors, NameTheValueAndWhatIsAllowed) {
  for (const int length : {-2, 0, 3, 39, 42}) {
    try {
      daubechies_filter(length);
      FAIL() << length << " was accepted";
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("coefficients is " + std::to_string(length)), std::string::npos) << message;
      EXPECT_NE(message.find("2..40"), std::string::npos) << message;
    }
  }
}

TEST(BsplineFilter, IsTheBinomialRowAndHasAllZerosAtPi) {
  const Eigen::VectorXd cubic = bspline_filter(3);
  const Eigen::VectorXd expected = (Eigen::VectorXd(5) << 1, 4, 6, 4, 1).finished() / 8.0;
  EXPECT_EQ(cubic, expected);
  for (int degree = 0; degree < 20; ++degree) {
    const Eigen::VectorXd filter = bspline_filter(degree);
    EXPECT_NEAR(filter.sum(), 2.0, 4 * eps);
    EXPECT_EQ(zeros_at_pi(filter), degree + 1);
  }
  EXPECT_THROW(bspline_filter(-1), std::invalid_argument);
  EXPECT_THROW(bspline_filter(20), std::invalid_argument);
}

TEST(SobolevExponent, IsDegreeAndAHalfForBsplines) {
  for (int degree = 0; degree < 20; ++degree)
    EXPECT_NEAR(sobolev_exponent(bspline_filter(degree)), degree + 0.5, 64 * eps * (degree + 1));
}

TEST(SobolevExponent, DoesNotDependOnTheChoiceOfRoots) {
  const Eigen::VectorXd reversed = daubechies_filter(16).reverse();
  EXPECT_NEAR(sobolev_exponent(reversed), sobolev_exponent(daubechies_filter(16)), 64 * eps);
}

// q = 1 + a - a e^{-i xi}: on span{1, cos} the transfer operator of |q|^2 is triangular, with the eigenvalues
// 2 ((1 + a)^2 + a^2) and -2 a (1 + a).
TEST(SobolevExponent, MatchesATwoTermQuotientInClosedForm) {
  const double a = 0.3;
  const Eigen::Vector3d filter(1 + a, 1.0, -a);
  const double radius = 2 * ((1 + a) * (1 + a) + a * a);
  EXPECT_NEAR(sobolev_exponent(filter), 1 - 0.5 * std::log2(radius), 1e-12);
}

TEST(SobolevExponent, RejectsFiltersWithoutRefinableFunction) {
  EXPECT_THROW(sobolev_exponent(Eigen::VectorXd()), std::invalid_argument);
  EXPECT_THROW(sobolev_exponent(Eigen::Vector2d(0.5, 0.5)), std::invalid_argument);
  EXPECT_THROW(sobolev_exponent(Eigen::Vector2d(1.5, 0.5)), std::invalid_argument);
  EXPECT_THROW(sobolev_exponent(Eigen::Vector2d(1.0, std::nan(""))), std::invalid_argument);
}

TEST(HoelderLowerBound, IsExactForBsplines) {
  for (int degree = 0; degree < 12; ++degree) {
    EXPECT_NEAR(hoelder_lower_bound(bspline_filter(degree), 6), degree, 1e-12);
  }
  EXPECT_THROW(hoelder_lower_bound(bspline_filter(1), 0), std::invalid_argument);
  EXPECT_THROW(hoelder_lower_bound(bspline_filter(1), 21), std::invalid_argument);
}

TEST(HoelderLowerBound, StaysBelowTheSobolevExponent) {
  for (int length = 4; length <= 40; length += 2) {
    const Eigen::VectorXd filter = daubechies_filter(length);
    const double bound = hoelder_lower_bound(filter, 10), sobolev = sobolev_exponent(filter);
    EXPECT_LT(bound, sobolev) << length;
    EXPECT_GT(bound, sobolev - 0.5) << length;
  }
}

}  // namespace
}  // namespace wavebalance::wavelets
