#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "enumerators.hpp"
#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::app {
namespace {

const BasisPair fourier{"fourier", "fourier"}, spline{"bspline", "bspline"}, haar{"haar", "fourier"};

SolvePoint solved(const BasisPair& pair, int functions, double seconds, double error) {
  SolvePoint point;
  point.pair = pair;
  point.functions = functions;
  point.points = 2 * (functions + functions % 2);
  point.seconds = seconds;
  point.error = point.displacement_error = error;
  point.converged = true;
  point.status = "converged";
  return point;
}

SolvePoint failed(const BasisPair& pair, int functions, double seconds) {
  SolvePoint point = solved(pair, functions, seconds, 1e-9);
  point.converged = false;
  point.status = "stalled";
  return point;
}

Recommendation recommended(const std::vector<SolvePoint>& points, double error, double reference = 1e-11) {
  return recommend(points, error, reference, Time{});
}

TEST(Recommendation, IsTheCheapestThatReachesTheErrorAndSaysHowMuchLongerFourierTakes) {
  const auto found = recommended({solved(fourier, 63, 8e-4, 5e-3), solved(fourier, 31, 1e-5, 5e-2),
                                  solved(spline, 64, 1e-4, 9e-3), solved(haar, 64, 2e-4, 1e-3)},
                                 1e-2);
  ASSERT_TRUE(found.choice && found.fourier);
  EXPECT_EQ(found.choice->pair, spline);
  EXPECT_EQ(found.matters, BasisMatters::much);
  EXPECT_DOUBLE_EQ(found.fourier_time_ratio(), 8.0);
  EXPECT_EQ(
      found.sentences,
      "For an error of 0.01 in the displacement the cheapest pair is B-spline:B-spline with 64 functions and "
      "128 points: 100 µs per solve (error 0.009 in displacement). The basis matters: Fourier:Fourier with 63 functions and 128 points "
      "needs 8.0 times as long (800 µs).");
}

TEST(Recommendation, SaysThatTheBasisMattersLittleUpToTwiceTheTime) {
  const auto at = [](double seconds) {
    return recommended({solved(fourier, 63, seconds, 5e-3), solved(spline, 64, 1e-4, 9e-3)}, 1e-2);
  };
  EXPECT_EQ(at(1.9e-4).matters, BasisMatters::little);
  EXPECT_NE(at(1.9e-4).sentences.find("The basis matters little: Fourier:Fourier"), std::string::npos);
  EXPECT_EQ(at(2.1e-4).matters, BasisMatters::much);
}

TEST(Recommendation, TakesFourierWhereItIsAtMostATenthSlowerAndNamesTheNextPair) {
  const auto found = recommended({solved(fourier, 63, 1.05e-4, 5e-3), solved(spline, 64, 1e-4, 9e-3)}, 1e-2);
  EXPECT_EQ(found.choice->pair, fourier);
  EXPECT_EQ(found.runner_up->pair, spline);
  EXPECT_EQ(found.matters, BasisMatters::little);
  EXPECT_NE(
      found.sentences.find("The basis matters little: the next pair, B-spline:B-spline with 64 functions and "
                           "128 points, needs as long (100 µs)."),
      std::string::npos)
      << found.sentences;
}

TEST(Recommendation, NamesTheNextPairThatMissesTheErrorByLittleBeforeOneThatIsMuchLater) {
  const auto found = recommended(
      {solved(fourier, 63, 1e-4, 9e-3), solved(spline, 64, 1.1e-4, 1.2e-2), solved(haar, 64, 9e-4, 5e-3)},
      1e-2);
  EXPECT_EQ(found.choice->pair, fourier);
  EXPECT_EQ(found.runner_up->pair, spline);
  EXPECT_NE(
      found.sentences.find("The basis matters little: the next pair, B-spline:B-spline with 64 functions and "
                           "128 points, has 0.012 in 110 µs."),
      std::string::npos)
      << found.sentences;
}

TEST(Recommendation, OfEqualTimesTheFewerFunctions) {
  const auto found = cheapest({solved(spline, 64, 1e-4, 1e-3), solved(haar, 32, 1e-4, 2e-3)}, 1e-2);
  EXPECT_EQ(found->pair, haar);
}

TEST(Recommendation, OfTimesOfOnePairThatDifferByATenthTheFewerFunctions) {
  const std::vector<SolvePoint> points{solved(fourier, 3, 1.05e-6, 1e-14), solved(fourier, 7, 1e-6, 1e-14),
                                       solved(spline, 2, 1.08e-6, 1e-4)};
  EXPECT_EQ(cheapest(points, 1e-2)->functions, 3);
  EXPECT_EQ(recommended(points, 1e-2).choice->functions, 3);
  EXPECT_EQ(cheapest({solved(fourier, 3, 2e-6, 1e-14), solved(fourier, 7, 1e-6, 1e-14)}, 1e-2)->functions, 7);
}

TEST(Recommendation, NeverTakesASolveThatFailed) {
  const auto found = recommended({failed(fourier, 31, 1e-6), solved(fourier, 63, 1e-3, 1e-3)}, 1e-2);
  EXPECT_EQ(found.choice->functions, 63);
  const auto none = recommended({failed(fourier, 31, 1e-6), failed(spline, 32, 1e-6)}, 1e-2);
  EXPECT_FALSE(none.choice);
  EXPECT_EQ(none.matters, BasisMatters::no_choice);
  EXPECT_EQ(
      none.sentences,
      "No pair reaches an error of 0.01 in the displacement within the budget. None of the solves has converged with a "
      "known error.");
}

TEST(Recommendation, SaysWhatComesNearestWhereNoPairReachesTheError) {
  const auto found = recommended({solved(fourier, 63, 8e-4, 5e-3), solved(spline, 64, 1e-4, 9e-3)}, 1e-4);
  EXPECT_FALSE(found.choice);
  EXPECT_TRUE(found.time_table.empty());
  EXPECT_TRUE(std::isnan(found.fourier_time_ratio()));
  EXPECT_EQ(
      found.sentences,
      "No pair reaches an error of 10⁻⁴ in the displacement within the budget. Fourier:Fourier with 63 functions and 128 "
      "points comes nearest, with 0.005 in 800 µs.");
}

TEST(Recommendation, SaysThatFourierDoesNotReachTheErrorAndItsSmallest) {
  const auto found = recommended({solved(fourier, 63, 8e-4, 5e-3), solved(spline, 64, 1e-4, 9e-5)}, 1e-4);
  EXPECT_EQ(found.matters, BasisMatters::fourier_fails);
  EXPECT_NE(found.sentences.find("Fourier:Fourier does not reach it within the budget, its smallest error is "
                                 "0.005."),
            std::string::npos)
      << found.sentences;
  EXPECT_EQ(recommended({solved(spline, 64, 1e-4, 9e-5)}, 1e-4).matters, BasisMatters::not_compared);
}

TEST(Recommendation, PassesOverASizeWhoseNextOneDoesNotKeepToTheError) {
  const std::vector<SolvePoint> points{solved(spline, 32, 1e-5, 1e-3), solved(spline, 64, 2e-5, 4e-2),
                                       solved(spline, 128, 5e-5, 3e-3)};
  EXPECT_FALSE(is_steady(points[0], points, 1e-2));
  EXPECT_EQ(cheapest(points, 1e-2)->functions, 128);
  // Better than none.
  const std::vector<SolvePoint> lucky(points.begin(), points.begin() + 2);
  EXPECT_EQ(cheapest(lucky, 1e-2)->functions, 32);
  EXPECT_NE(recommended(lucky, 1e-2).sentences.find("but the next size is less accurate"), std::string::npos);
  // 31 and 63 functions are a series as 32 and 64 are.
  EXPECT_FALSE(is_steady(solved(fourier, 31, 1.0, 1e-3), {solved(fourier, 63, 1.0, 1.0)}, 1e-2));
}

TEST(Recommendation, KnowsNothingBelowAQuarterOfTheErrorOfTheReference) {
  const std::vector<SolvePoint> points{solved(fourier, 63, 8e-4, 5e-6)};
  EXPECT_TRUE(recommended(points, 1e-4, 2e-5).choice);
  const auto found = recommended(points, 1e-4, 3e-5);
  EXPECT_FALSE(found.choice);
  EXPECT_NE(
      found.sentences.find(
          "Whether a pair reaches an error of 10⁻⁴ in the displacement is not known, because the "
          "reference has an error of about 3·10⁻⁵. A larger budget refines it. Fourier:Fourier with 63 functions and "
          "128 points is below this in 800 µs."),
      std::string::npos)
      << found.sentences;
}

TEST(Recommendation, NamesAMuchFasterSizeThatMissesTheErrorByLittle) {
  const auto at = [](double seconds) {
    return recommended({solved(fourier, 63, seconds, 1.04e-4), solved(spline, 128, 1e-2, 8e-5)}, 1e-4);
  };
  EXPECT_FALSE(at(6e-3).near_miss);
  EXPECT_NE(at(1e-3).sentences.find("; Fourier:Fourier with 63 functions and 128 points has 10⁻⁴ in 1 ms."),
            std::string::npos)
      << at(1e-3).sentences;
}

TEST(Recommendation, SaysThatTheBasisMattersLittleWhereFourierMissesTheErrorByLittle) {
  std::vector<SolvePoint> points{solved(fourier, 31, 1.7e-4, 1.1e-2), solved(spline, 32, 1.6e-4, 9.9e-3)};
  const auto never = recommended(points, 1e-2);
  EXPECT_EQ(never.matters, BasisMatters::little);
  EXPECT_NE(
      never.sentences.find("The basis matters little: Fourier:Fourier with 31 functions and 64 points has "
                           "0.011 in 170 µs."),
      std::string::npos)
      << never.sentences;
  points.push_back(solved(fourier, 63, 7e-4, 2e-3));
  const auto later = recommended(points, 1e-2);
  EXPECT_EQ(later.matters, BasisMatters::little);
  EXPECT_NE(later.sentences.find("in 170 µs, and reaches it with 63 and 128 in 700 µs."), std::string::npos)
      << later.sentences;
  points.front().error = 1.6e-2;
  EXPECT_EQ(recommended(points, 1e-2).matters, BasisMatters::much);
}

SolvePoint exact_point(double seconds, double error) {
  SolvePoint point = solved(BasisPair::exact(), 31, seconds, error);
  point.method = "phases";
  point.tolerance = 1e-8;
  return point;
}

TEST(Recommendation, NamesExactSolutionsWhereTheyAreFasterAndKeepsThePair) {
  const std::vector<SolvePoint> pairs{solved(fourier, 63, 8e-4, 5e-7)};
  const auto with = [&](double seconds, double error) {
    std::vector<SolvePoint> points = pairs;
    points.push_back(exact_point(2.0 * seconds, 1e-12));
    points.push_back(exact_point(seconds, error));
    return recommended(points, 1e-6);
  };
  const auto faster = with(1e-4, 1e-8);
  ASSERT_TRUE(faster.choice && faster.exact);
  EXPECT_EQ(faster.choice->pair, fourier);
  EXPECT_EQ(faster.exact->seconds, 1e-4);
  EXPECT_NE(
      faster.sentences.find(
          " The exact solution is faster: 100 µs from harmonic balance with 31 functions and 64 points (error "
          "10⁻⁸ in displacement). A run with these sizes also reports "),
      std::string::npos)
      << faster.sentences;
  for (const auto& found : {with(8e-4, 1e-8), with(1e-2, 1e-8), with(4.1e-4, 1e-5)}) {
    EXPECT_FALSE(found.exact);
    EXPECT_EQ(found.sentences.find("phases"), std::string::npos);
  }
}

TEST(Recommendation, NamesExactSolutionsWhereNoPairReachesTheError) {
  const auto found = recommended({solved(fourier, 63, 8e-4, 5e-3), exact_point(1e-2, 1e-8)}, 1e-6);
  EXPECT_FALSE(found.choice);
  ASSERT_TRUE(found.exact);
  EXPECT_NE(found.sentences.find(" The exact solution reaches it: 10 ms from harmonic balance"),
            std::string::npos)
      << found.sentences;
  // Not known if the reference lacks it.
  EXPECT_FALSE(recommended({exact_point(1e-2, 1e-8)}, 1e-6, 1e-6).exact);
}

TEST(Recommendation, SaysWhatReachesTheErrorByTheDisplacementAloneWhereTheForceDoesNot) {
  SolvePoint rough = solved(fourier, 63, 8e-4, 5e-3);
  rough.force_error = rough.error = 0.55;
  const auto found = recommend({rough}, 1e-2, 1e-11, Time{}, ErrorMeasure::both);
  EXPECT_FALSE(found.choice);
  EXPECT_NE(found.sentences.find("No pair reaches an error of 0.01 in displacement and force"),
            std::string::npos);
  EXPECT_NE(found.sentences.find("In displacement only, Fourier:Fourier with 63 functions and 128 "
                                 "points reaches it in 800 µs (--error displacement)."),
            std::string::npos)
      << found.sentences;
}

TEST(Recommendation, GivesTheTimeTableOfItsChoice) {
  Time time;
  time.inner_products = InnerProducts::exact;
  const auto of = [&](const SolvePoint& point) { return recommend({point}, 1e-2, 0.0, time).time_table; };
  EXPECT_EQ(of(solved(spline, 64, 1e-4, 9e-3)),
            "[time]\ntrial = \"bspline\"\nweight = \"bspline\"\nfunctions = 64\nquadrature_points = 128\n"
            "formulation = \"distributional\"\ninner_products = \"exact\"\nnyquist = \"drop\"\n");
  EXPECT_EQ(of(solved(fourier, 63, 1e-4, 9e-3)).find("nyquist"), std::string::npos);
  time.sample_offset = 0.5;
  EXPECT_NE(of(solved(fourier, 63, 1e-4, 9e-3)).find("\nsample_offset = 0.5\n"), std::string::npos);
}

TEST(Recommendation, NamesEveryAnswerToWhetherTheBasisMatters) {
  std::set<std::string_view> names;
  for (const auto matters : enumerators<BasisMatters>()) names.insert(to_string(matters));
  EXPECT_EQ(names,
            (std::set<std::string_view>{"no_choice", "little", "much", "fourier_fails", "not_compared"}));
}

}  // namespace
}  // namespace wavebalance::app
