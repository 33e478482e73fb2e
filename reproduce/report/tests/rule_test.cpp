#include "wavebalance/report/rule.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace wavebalance::report {
namespace {

TEST(Rule, LowerHoldsForMoreThanHalfOfTheSizesBeyondTies) {
  EXPECT_EQ(lower({1, 1, 1}, {2, 2, 1}), Verdict::agrees);
  EXPECT_EQ(lower({1, 1, 1}, {1.09, 1.09, 2}), Verdict::partly);
  EXPECT_EQ(lower({2, 2, 1}, {1, 1, 2}), Verdict::differs);
  EXPECT_EQ(lower({1, 2}, {2, 1}), Verdict::differs);
  EXPECT_EQ(lower({1.0}, {1.1}), Verdict::partly);
  EXPECT_EQ(lower({1.0}, {1.11}), Verdict::agrees);
  EXPECT_EQ(lower({0.0}, {1e-300}), Verdict::agrees);
  EXPECT_EQ(lower({0.0}, {0.0}), Verdict::partly);
}

TEST(Rule, ComparisonsOfOtherLengthsAndOfMissingValuesAreErrors) {
  EXPECT_THROW(lower({}, {}), std::invalid_argument);
  EXPECT_THROW(lower({1}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(lower({1}, {std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(similar({-1}, {1}), std::invalid_argument);
  EXPECT_THROW(invisible(std::numeric_limits<double>::quiet_NaN(), 1.0), std::invalid_argument);
  EXPECT_THROW(invisible(0.1, 0.0), std::invalid_argument);
}

TEST(Rule, PartsAgreeTogetherOnlyIfAllDo) {
  using enum Verdict;
  EXPECT_EQ(together({agrees, agrees}), agrees);
  EXPECT_EQ(together({agrees, differs}), partly);
  EXPECT_EQ(together({agrees, partly}), partly);
  EXPECT_EQ(together({partly, partly}), partly);
  EXPECT_EQ(together({partly, differs}), differs);
  EXPECT_EQ(together({differs, differs}), differs);
  EXPECT_THROW(together({}), std::invalid_argument);
  EXPECT_THROW(together({agrees, depends}), std::invalid_argument);
}

TEST(Rule, InvisibleIsTwoPercentOfTheAxisAndSimilarAFactorOfTwo) {
  EXPECT_EQ(invisible(0.02, 1.0), Verdict::agrees);
  EXPECT_EQ(invisible(0.021, 1.0), Verdict::differs);
  EXPECT_EQ(similar({1, 1, 1}, {2, 0.5, 3}), Verdict::agrees);
  EXPECT_EQ(similar({1, 1}, {2, 2.1}), Verdict::differs);
}

TEST(Rule, ReadingsThatDifferMakeAStatementDepend) {
  using enum Verdict;
  EXPECT_EQ(over({{"a", agrees, ""}, {"b", agrees, ""}}), agrees);
  EXPECT_EQ(over({{"a", agrees, ""}, {"b", differs, ""}}), depends);
  EXPECT_EQ(agreeing({{"a", agrees, ""}, {"b", partly, ""}, {"c", agrees, ""}}), 2);
  EXPECT_THROW(over({}), std::invalid_argument);
}

TEST(Rule, ItsTextHasItsFigures) {
  std::string text;
  for (const auto& sentence : rule_text()) text += sentence;
  for (const char* figure : {"10 %", "2 %", "factor of 2"})
    EXPECT_NE(text.find(figure), std::string::npos) << figure;
}

}  // namespace
}  // namespace wavebalance::report
