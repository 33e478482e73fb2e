#include "wavebalance/report/rule.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace wavebalance::report {
namespace {

TEST(Rule, LowerHoldsForMoreThanHalfOfTheSizesBeyondTies) {
  EXPECT_EQ(lower({1, 1, 1}, {2, 2, 1}), Verdict::agrees);
  EXPECT_EQ(lower({1, 1, 1}, {1.09, 1.09, 2}), Verdict::ties);
  EXPECT_EQ(lower({2, 2, 1}, {1, 1, 2}), Verdict::differs);
  EXPECT_EQ(lower({1, 2}, {2, 1}), Verdict::ties);
  EXPECT_EQ(lower({1.0}, {1.1}), Verdict::ties);
  EXPECT_EQ(lower({1.0}, {1.11}), Verdict::agrees);
  EXPECT_EQ(lower({0.0}, {1e-300}), Verdict::agrees);
  EXPECT_EQ(lower({0.0}, {0.0}), Verdict::ties);
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
  EXPECT_EQ(together({partly, differs}), partly);
  EXPECT_EQ(together({differs, differs}), differs);
  EXPECT_THROW(together({}), std::invalid_argument);
  EXPECT_THROW(together({agrees, depends}), std::invalid_argument);
}

TEST(Rule, ATieAndAWinAgreeAndATieAndALossDiffer) {
  using enum Verdict;
  EXPECT_EQ(together({agrees, ties}), agrees);
  EXPECT_EQ(together({ties, ties}), ties);
  EXPECT_EQ(together({ties, differs}), differs);
  EXPECT_EQ(together({ties, partly}), partly);
  EXPECT_EQ(together({agrees, ties, differs}), partly);
}

TEST(Rule, AMisprintFailsAsPrintedAndHoldsAsCorrected) {
  EXPECT_EQ(misprint(Verdict::differs, Verdict::agrees), Verdict::misprint);
  EXPECT_EQ(misprint(Verdict::differs, Verdict::differs), Verdict::differs);
  EXPECT_EQ(misprint(Verdict::agrees, Verdict::agrees), Verdict::agrees);
}

TEST(Rule, InvisibleIsTwoPercentOfTheRangeAndSimilarAFactorOfTwo) {
  EXPECT_EQ(invisible(0.02, 1.0), Verdict::agrees);
  EXPECT_EQ(invisible(0.021, 1.0), Verdict::differs);
  EXPECT_EQ(similar({1, 1, 1}, {2, 0.5, 3}), Verdict::agrees);
  EXPECT_EQ(similar({1, 1}, {2, 2.1}), Verdict::ties);
  EXPECT_EQ(similar({1, 1, 1}, {2, 2.1, 3}), Verdict::differs);
}

TEST(Rule, AStatementDependsOnlyWhereSomeReadingAgreesAndSomeDoesNot) {
  using enum Verdict;
  const auto over_two = [](Verdict first, Verdict second) {
    return over({{"a", first, ""}, {"b", second, ""}});
  };
  EXPECT_EQ(over_two(agrees, agrees), agrees);
  EXPECT_EQ(over_two(agrees, differs), depends);
  EXPECT_EQ(over_two(agrees, partly), depends);
  EXPECT_EQ(over_two(partly, differs), differs);
  EXPECT_EQ(over_two(ties, partly), partly);
  EXPECT_EQ(over_two(partly, partly), partly);
  EXPECT_THROW(over({}), std::invalid_argument);
}

TEST(Rule, ReadingsThatTheTextDoesNotAllowDecideNothing) {
  using enum Verdict;
  const std::vector<Reading> readings{
      {"of the text", differs, ""}, {"another", agrees, "", false}, {"one more", partly, "", false}};
  EXPECT_EQ(over(readings), differs);
  EXPECT_EQ(agreeing(readings), 0);
  EXPECT_EQ(agreeing(readings, false), 1);
  EXPECT_EQ(of_text(readings, false).size(), 2u);
  EXPECT_THROW(over(of_text(readings, false)), std::invalid_argument);
}

TEST(Rule, ItsTextHasItsFigures) {
  std::string text;
  for (const auto& sentence : rule_text()) text += sentence;
  for (const char* figure :
       {"10 %", "2 %", "factor of 2", "1/64", "1/4", "4 doublings", "10 and 100 times", "10⁻⁹"})
    EXPECT_NE(text.find(figure), std::string::npos) << figure;
}

}  // namespace
}  // namespace wavebalance::report
