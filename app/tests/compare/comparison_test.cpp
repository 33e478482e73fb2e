// Comparisons that end early, and the counts and orders of points that are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/bar_scene.hpp"
#include "support/brief_comparison.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::app {
namespace {

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
  for (const SolvePoint& point : found.points) EXPECT_LE(point.functions, point.pair.is_exact() ? 1023 : 16);
  const ComparisonRecord record = comparison_record(scene_of(), found);
  EXPECT_EQ(value_of<std::string>(record.summary, "status"), "interrupted");
  EXPECT_EQ(record.table.rows(), found.points.size());
}

TEST(Comparison, ThatHasNoTimeLeftAfterItsReferenceSaysSoAndRecommendsNothing) {
  Comparison found;
  found.reference.converged = true;
  found.reference.status = "converged";
  found.reference.text = "the exact periodic solution";
  found.recommendations.emplace_back().sentences = "No pair reaches an error of 1e-2 within the budget.";
  EXPECT_FALSE(found.converged());
  EXPECT_EQ(found.status(), "no_time");
  const ComparisonRecord record = comparison_record(scene_of(), found);
  for (const std::string& text : {record.text, record.markdown}) {
    EXPECT_NE(text.find("No time was left to compare pairs"), std::string::npos) << text;
    EXPECT_EQ(text.find("No pair reaches"), std::string::npos) << text;
  }
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
        std::max(std::pow(functions, -3.0), 1e-6);  // a floor below twice the reference's
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

}  // namespace
}  // namespace wavebalance::app
