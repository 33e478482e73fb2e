#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "enumerators.hpp"
#include "support/bar_scene.hpp"
#include "support/brief_comparison.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compare/comparison_figure.hpp"
#include "wavebalance/app/compare/comparison_record.hpp"

namespace wavebalance::app {
namespace {

std::string refusal_of(const Scene& scene, const ComparisonOptions& options) {
  try {
    check_comparison(scene, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

Comparison compared_by(std::optional<ErrorMeasure> measure, const Scene& scene = scene_of()) {
  ComparisonOptions options = brief(2.0);
  options.measure = measure;
  return compare_responses(scene, options);
}

TEST(ErrorMeasures, AreReadByTheirNamesAndErrorsSayWhatIsAllowed) {
  std::set<ErrorMeasure> all;
  for (const auto measure : enumerators<ErrorMeasure>()) {
    EXPECT_EQ(parse_error_measure(std::string(to_string(measure))), measure);
    all.insert(measure);
  }
  EXPECT_EQ(all.size(), 3u);
  try {
    parse_error_measure("energy");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "--error energy: expected displacement, force or both");
  }
}

TEST(ErrorMeasures, TakeOnePartOrTheLargerAndKnowNothingWhereAPartIsMissing) {
  EXPECT_EQ(weighed_error(ErrorMeasure::displacement, 1e-3, 1e-2), 1e-3);
  EXPECT_EQ(weighed_error(ErrorMeasure::force, 1e-3, 1e-2), 1e-2);
  EXPECT_EQ(weighed_error(ErrorMeasure::both, 1e-3, 1e-2), 1e-2);
  EXPECT_EQ(weighed_error(ErrorMeasure::both, 1e-1, 1e-2), 1e-1);
  EXPECT_EQ(weighed_error(ErrorMeasure::displacement, 1e-3, solvers::missing), 1e-3);
  EXPECT_TRUE(std::isnan(weighed_error(ErrorMeasure::both, 1e-3, solvers::missing)));
  EXPECT_TRUE(std::isnan(weighed_error(ErrorMeasure::both, solvers::missing, 1e-3)));
}

TEST(ErrorMeasures, OfBothRecommendNoMotionWhoseForceIsWrong) {
  const Comparison of_displacement = compared_by(ErrorMeasure::displacement), of_both = compared_by({});
  EXPECT_EQ(of_both.measure, ErrorMeasure::both);
  const auto &one = of_displacement.recommendations.front(), &other = of_both.recommendations.front();
  ASSERT_TRUE(one.choice && other.choice);
  EXPECT_LE(one.choice->displacement_error, 1e-2);
  EXPECT_GT(one.choice->force_error, 2e-2);
  EXPECT_LE(other.choice->displacement_error, 1e-2);
  EXPECT_LE(other.choice->force_error, 1e-2);
  for (const SolvePoint& point : of_both.points) {
    if (!point.converged) continue;
    EXPECT_EQ(point.error, std::max(point.displacement_error, point.force_error));
  }
}

TEST(ErrorMeasures, AreNamedBySentencesTablesAndTheAxis) {
  for (const auto measure : {ErrorMeasure::displacement, ErrorMeasure::force, ErrorMeasure::both}) {
    const Comparison found = compared_by(measure);
    const std::string subject = subject_of(measure);
    const ComparisonRecord record = comparison_record(scene_of(), found);
    EXPECT_NE(record.text.find("For an error of 1e-2 of " + subject), std::string::npos) << record.text;
    EXPECT_EQ(value_of<std::string>(record.summary, "error_of"), to_string(measure));
    const Table recommended = value_of<Table>(record.summary, "recommendations");
    EXPECT_EQ(cell_text(recommended.at(0, "error_of")), to_string(measure));
    for (const Figure& figure : {error_over_time(found), error_over_functions(found)})
      EXPECT_EQ(figure.panels.front().y.label, "Relative rms error of " + subject);
  }
}

TEST(ErrorMeasures, OfAForceThatDoesNotActAreThoseOfTheDisplacementAndTheRecordSaysSo) {
  const Scene open = scene_of({"contact.gap=1.0"});
  const Comparison by_default = compared_by({}, open), asked = compared_by(ErrorMeasure::force, open);
  for (const Comparison& found : {by_default, asked}) {
    EXPECT_EQ(found.measure, ErrorMeasure::displacement);
    const ComparisonRecord record = comparison_record(open, found);
    EXPECT_NE(record.text.find("Errors are those of the displacement, because no contact force acts."),
              std::string::npos)
        << record.text;
  }
  EXPECT_TRUE(comparison_record(open, by_default).warnings.empty());
  EXPECT_EQ(comparison_record(open, asked).warnings.size(), 1u);
}

TEST(ErrorMeasures, OfTheForceAreRefusedForSweepsWithWhatIsAllowed) {
  const Scene sweep =
      scene_of({"analysis.type=frequency_sweep", "analysis.frequency_from=100", "analysis.frequency_to=110"});
  ComparisonOptions options = brief();
  EXPECT_EQ(refusal_of(sweep, options), "");
  options.measure = ErrorMeasure::displacement;
  EXPECT_EQ(refusal_of(sweep, options), "");
  options.measure = ErrorMeasure::force;
  EXPECT_EQ(refusal_of(sweep, options),
            "--error force: curves of a sweep are compared by their displacements; expected displacement");
}

}  // namespace
}  // namespace wavebalance::app
