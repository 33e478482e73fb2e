#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "support/bar_scene.hpp"
#include "support/brief_comparison.hpp"
#include "support/closed_stop.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compare/comparison_record.hpp"
#include "wavebalance/app/compare/size_study.hpp"

namespace wavebalance::app {
namespace {

/// Re (K + i w C - w^2 M)^-1 load exp(i w t) at the contact.
Eigen::RowVectorXd linear_response(const Scene& scene, int points) {
  const auto structure = make_model(scene).structure;
  const double omega = 2.0 * std::numbers::pi * scene.forcing.frequency;
  const std::complex<double> i(0.0, 1.0);
  const Eigen::MatrixXcd stiffness = Eigen::MatrixXd(structure.stiffness).cast<std::complex<double>>() +
                                     i * omega * Eigen::MatrixXd(structure.damping) -
                                     omega * omega * Eigen::MatrixXd(structure.mass);
  const Eigen::VectorXcd amplitude = stiffness.lu().solve(structure.load.cast<std::complex<double>>());
  const std::complex<double> tip = amplitude[amplitude.size() - 1];
  Eigen::RowVectorXd values(points);
  for (int l = 0; l < points; ++l)
    values[l] = (tip * std::exp(2.0 * std::numbers::pi * i * double(l) / double(points))).real();
  return values;
}

TEST(Comparison, OfALinearSceneIsWithTheClosedFormAndThreeFourierFunctionsAreExact) {
  const Scene scene = scene_of({"contact.gap=1.0"});
  const Comparison found = compare_responses(scene, brief());
  EXPECT_EQ(found.reference.kind, "linear");
  EXPECT_EQ(found.reference.stability.status, "stable");
  const Eigen::RowVectorXd exact = linear_response(scene, found.reference.motion.points());
  EXPECT_LT((found.reference.motion.displacement - exact).norm() / exact.norm(), 1e-12);
  ASSERT_FALSE(found.points.empty());
  EXPECT_EQ(found.points.front().functions, 3);
  EXPECT_LT(found.points.front().error, 1e-12);
  ASSERT_EQ(found.recommendations.size(), 3u);
  // Solves of few functions take microseconds, whose order depends on the load of the machine.
  for (const Recommendation& one : found.recommendations) {
    ASSERT_TRUE(one.choice) << one.sentences;
    EXPECT_LE(one.choice->error, one.error);
    ASSERT_TRUE(one.fourier);
    EXPECT_LT(one.fourier->error, 1e-12);
  }
  // Splines approximate a cosine: never exact.
  EXPECT_GT(found.pairs[1].smallest_error, 1e-10);
}

TEST(Comparison, WithoutAnObstacleIsWithTheLinearResponse) {
  const Scene scene =
      parse_scene(bar_scene, "case.toml", std::vector<std::string>{"contact.law=none"},
                  std::vector<std::string>{"contact.constant", "contact.exponent", "contact.gap"});
  EXPECT_EQ(find_reference(scene, make_model(scene), 64, 1.0).kind, "linear");
}

TEST(Comparison, OfAnElasticContactIsWithContactPhasesAndItsRecommendationsHoldWhenPasted) {
  const Scene scene = scene_of();
  const Comparison found = compare_responses(scene, brief(2.0));
  EXPECT_EQ(found.reference.kind, "phases");
  EXPECT_TRUE(found.converged());
  ASSERT_TRUE(found.recommendations.front().choice);
  const Recommendation& one = found.recommendations.front();
  EXPECT_EQ(one.stability, "stable");
  EXPECT_LE(one.choice->error, 1e-2);
  const auto begin = bar_scene.find("[time]");
  std::string pasted = bar_scene;
  pasted.replace(begin, bar_scene.find("[analysis]") - begin, one.time_table);
  const Response again = weighted_residual_response(parse_scene(pasted, "pasted.toml"));
  ASSERT_TRUE(again.converged);
  EXPECT_NEAR(displacement_error(again.contacts, found.reference.motion), one.choice->displacement_error,
              1e-9);
  EXPECT_NEAR(force_error(again.contacts, found.reference.motion), one.choice->force_error, 1e-6);
  // Order 2 of the points, at least, where the force has kinks.
  EXPECT_GT(found.pairs[0].order, 1.5);
}

TEST(Comparison, OfARigidBarIsWithContactPhases) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case1_rigid.toml");
  ComparisonOptions options = brief(30.0);
  options.largest_functions = 64;
  options.errors = {1e-2};
  options.measure = ErrorMeasure::displacement;
  const Comparison found = compare_responses(scene, options);
  EXPECT_EQ(found.reference.kind, "phases");
  EXPECT_LT(found.reference.error, 1e-11);
  ASSERT_TRUE(found.recommendations.front().choice);
  EXPECT_EQ(found.pairs.back().pair, BasisPair::phases());
}

TEST(Comparison, TakesBothNumbersOfFourierFunctionsOnlyWhereTheSceneKeepsTheNyquistCoefficient) {
  const auto evens = [](const std::string& nyquist) {
    const Comparison found =
        compare_responses(scene_of({"contact.gap=1.0", "time.nyquist=" + nyquist}), brief());
    return std::count_if(found.points.begin(), found.points.end(), [](const SolvePoint& point) {
      return point.pair.is_fourier() && point.functions % 2 == 0;
    });
  };
  EXPECT_EQ(evens("drop"), 0);
  EXPECT_GT(evens("keep"), 0);
}

TEST(Comparison, AtTheMiddlesOfTheIntervalsRefusesAsManyFourierFunctionsAsPoints) {
  ComparisonOptions options = brief();
  options.largest_functions = 16;
  const Comparison found =
      compare_responses(scene_of({"time.sample_offset=0.5", "time.nyquist=keep"}), options);
  EXPECT_EQ(found.reference.kind, "phases");
  int refused = 0;
  for (const SolvePoint& point : found.points)
    if (point.status == "refused") {
      ++refused;
      EXPECT_EQ(point.functions, point.points);
    }
  EXPECT_GT(refused, 0);
}

TEST(Comparison, OfNoNamedPairsTakesEveryAdmissibleOneAndSaysWhyTheOthersAreNot) {
  ComparisonOptions options = brief();
  options.pairs.clear();
  options.largest_functions = 8;
  options.points_per_function = {2};
  const Comparison found = compare_responses(scene_of(), options);
  ASSERT_EQ(found.pairs.size(), 19u);
  EXPECT_EQ(found.pairs.front().pair, (BasisPair{"fourier", "fourier"}));
  for (const PairResult& pair : found.pairs) {
    if (pair.pair == BasisPair{"haar", "haar"}) {
      EXPECT_FALSE(pair.inadmissible.empty());
    }
    EXPECT_EQ(pair.inadmissible.empty(), pair.solves > 0) << name_of(pair.pair);
    if (pair.pair.is_phases()) {
      EXPECT_TRUE(pair.inadmissible.empty());
    }
  }
}

TEST(Comparison, RefusesWhatItCannotCompareAndSaysWhatIsAllowed) {
  const auto message = [](const Scene& scene, const ComparisonOptions& options) -> std::string {
    try {
      compare_responses(scene, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  ComparisonOptions inadmissible = brief();
  inadmissible.pairs = {{"haar", "haar"}};
  EXPECT_EQ(message(scene_of(), inadmissible).find("--pairs haar:haar: not an admissible pair: "), 0u);
  EXPECT_NE(
      message(scene_of({"analysis.type=time_stepping"}), brief()).find("analysis.type = \"time_stepping\""),
      std::string::npos);
  EXPECT_NE(message(scene_of({"analysis.subharmonic=2"}), brief()).find("analysis.subharmonic = 2"),
            std::string::npos);
  EXPECT_NE(message(scene_of(), brief(0.0)).find("--budget 0: expected seconds > 0"), std::string::npos);
  ComparisonOptions negative = brief();
  negative.threads = -1;
  EXPECT_EQ(message(scene_of(), negative), "--threads -1: expected at least 1, or 0 for one per core");
}

TEST(Comparison, ThatIsInterruptedHoldsWhatWasMeasuredSoFar) {
  const Comparison whole = compare_responses(scene_of(), brief());
  bool seen = false;
  const Comparison found = compare_responses(scene_of(), brief(), [&](const Progress& progress) {
    seen = seen || progress.phase == "bspline:bspline, 16 functions";
    return !seen;
  });
  EXPECT_TRUE(seen && found.interrupted);
  EXPECT_FALSE(found.converged());
  EXPECT_EQ(found.status(), "interrupted");
  EXPECT_FALSE(found.points.empty());
  EXPECT_LT(found.points.size(), whole.points.size());
  for (const SolvePoint& point : found.points) EXPECT_LE(point.functions, point.pair.is_phases() ? 1023 : 16);
  const ComparisonRecord record = comparison_record(scene_of(), found);
  EXPECT_EQ(value_of<std::string>(record.summary, "status"), "interrupted");
  EXPECT_EQ(record.table.rows(), found.points.size());
}

TEST(Comparison, ThatHasNoTimeLeftAfterItsReferenceSaysSoAndRecommendsNothing) {
  Comparison found;
  found.reference.converged = true;
  found.reference.status = "converged";
  found.reference.text = "contact phases";
  found.recommendations.emplace_back().sentences = "No pair reaches an error of 1e-2 within the budget.";
  EXPECT_FALSE(found.converged());
  EXPECT_EQ(found.status(), "no_time");
  const ComparisonRecord record = comparison_record(scene_of(), found);
  for (const std::string& text : {record.text, record.markdown}) {
    EXPECT_NE(text.find("No time was left to compare pairs"), std::string::npos) << text;
    EXPECT_EQ(text.find("No pair reaches"), std::string::npos) << text;
  }
}

TEST(Comparison, ALongReferenceLeavesTimeForThePairs) {
  // A stop that stays closed, and a loss factor, which contact phases do not take: its Newton matrix has a
  // row for every point, so that the finest level that a tolerance asks for takes many times the budget.
  const TemporaryFolder folder;
  const Scene scene = closed_stop(folder, {"structure.loss_factor=1e-6"});
  const Comparison found = compare_responses(scene, brief(2.0));
  EXPECT_EQ(found.reference.kind, "finer_balance");
  EXPECT_EQ(found.status(), "converged");
  EXPECT_FALSE(found.points.empty());
}

TEST(Comparison, WithoutTimeForAReferenceSaysSo) {
  const Comparison found = compare_responses(scene_of(), brief(1e-6));
  EXPECT_FALSE(found.converged());
  EXPECT_EQ(found.status(), "no_reference");
  EXPECT_TRUE(found.points.empty() && found.recommendations.empty());
}

TEST(PairResults, CountFailuresByStatusAndFitTheOrderAboveTheErrorOfTheReference) {
  std::vector<SolvePoint> points;
  for (int functions = 8; functions <= 128; functions *= 2) {
    SolvePoint point;
    point.pair = {"bspline", "bspline"};
    point.functions = functions;
    point.points = 2 * functions;
    point.converged = functions != 8;
    point.status = point.converged ? "converged" : "stalled";
    point.error = point.displacement_error =
        std::max(std::pow(functions, -3.0), 1e-6);  // a floor below twice that of the reference
    point.force_error = std::pow(functions, -1.0);
    points.push_back(point);
  }
  const PairResult found = pair_results({{"bspline", "bspline"}}, points, 1e-6).front();
  EXPECT_EQ(found.solves, 5);
  EXPECT_EQ(found.converged, 4);
  EXPECT_NEAR(found.order, 3.0, 1e-9);
  EXPECT_NEAR(found.force_order, 1.0, 1e-9);
  EXPECT_EQ(found.order_points_per_function, 2);
  EXPECT_EQ(found.failures, "1 stalled (8 functions)");
}

TEST(BasisPairs, AreDrawnEachInAWayOfItsOwnAndThoseOfThePaperSolid) {
  std::set<std::pair<Colour, Dash>> looks;
  int solid = 0;
  for (const BasisPair& pair : common_pairs()) {
    if (!admissibility_of(pair, scene_of()).admissible) continue;
    const PairStyle style = style_of(pair);
    EXPECT_TRUE(looks.emplace(style.colour, style.dash).second) << name_of(pair);
    solid += style.dash == Dash::solid;
  }
  EXPECT_EQ(solid, 6);
  EXPECT_TRUE(looks.emplace(style_of(BasisPair::phases()).colour, style_of(BasisPair::phases()).dash).second);
}

TEST(BasisPairs, AreReadFromTextAndErrorsNameWhatIsWrong) {
  EXPECT_EQ(parse_pairs("fourier:fourier,haar:fourier"),
            (std::vector<BasisPair>{{"fourier", "fourier"}, {"haar", "fourier"}}));
  const auto message = [](const std::string& text) -> std::string {
    try {
      parse_pairs(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("haar").find("\"haar\" is no pair; expected TRIAL:WEIGHT"), std::string::npos);
  EXPECT_NE(message("harr:fourier").find("\"harr\" is no basis; expected \"fourier\""), std::string::npos);
  EXPECT_NE(message("haar:fourier,haar:fourier").find("haar:fourier is there twice"), std::string::npos);
  EXPECT_NE(message("haar:fourier,").find("\"\" is no pair"), std::string::npos);
  EXPECT_EQ(label_of({"daubechies6", "bspline"}), "DB6:B-spline");
}

TEST(Comparison, OnTwoThreadsHasTheMotionsOfOneToTheLastDigit) {
  ComparisonOptions options = brief(20.0);
  options.largest_functions = 64;
  options.threads = 1;
  const Comparison expected = compare_responses(scene_of(), options);
  options.threads = 2;
  const Comparison found = compare_responses(scene_of(), options);
  int compared = 0;
  for (const SolvePoint& one : expected.points)
    for (const SolvePoint& other : found.points) {
      const bool same = one.pair == other.pair && one.functions == other.functions &&
                        one.points == other.points &&
                        (!one.pair.is_phases() || one.tolerance == other.tolerance);
      if (!same || !one.converged || !other.converged) continue;  // a solve may end for the time it takes
      EXPECT_EQ(one.error, other.error) << name_of(one.pair) << ' ' << one.functions;
      EXPECT_EQ(one.force_error, other.force_error) << name_of(one.pair) << ' ' << one.functions;
      ++compared;
    }
  EXPECT_GE(compared, 20);
  EXPECT_EQ(found.status(), "converged");
}

}  // namespace
}  // namespace wavebalance::app
