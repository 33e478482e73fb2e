// Comparisons near a motion that is given.
#include <gtest/gtest.h>

#include "support/brief_comparison.hpp"
#include "support/curve_record.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compare/comparison_record.hpp"
#include "wavebalance/app/compare/size_study.hpp"

namespace wavebalance::app {
namespace {

/// The motions of the oscillator with a stop at 0.18 Hz, by falling displacements: large, unstable, small.
Record three_motions() { return analyse(stop_with({"analysis.motion_at=0.18"})); }

TEST(CompareStart, LeadsTheReferenceAndEachSolveToTheMotionGiven) {
  const Record curve = three_motions();
  const StartMotion upper = start_of(curve, "motion_0.18Hz_1.csv");
  const StartMotion lower = start_of(curve, "motion_0.18Hz_3.csv");
  ASSERT_FALSE(upper.contacts.empty());
  ASSERT_FALSE(lower.contacts.empty());
  const double far = displacement_error(lower.contacts, upper.contacts);
  ASSERT_GT(far, 0.1);
  for (const StartMotion& start : {upper, lower}) {
    ComparisonOptions options = brief(3.0);
    options.start = start;
    const Comparison comparison = compare_responses(response_with(), options);
    ASSERT_TRUE(comparison.converged());
    EXPECT_TRUE(comparison.from_reference);
    EXPECT_EQ(comparison.reference.kind, "phases");
    const double largest = start.contacts.displacement.maxCoeff();
    EXPECT_NEAR(comparison.reference.motion.displacement.maxCoeff(), largest, 0.02 * largest);
    for (const SolvePoint& point : comparison.points)
      if (point.converged && point.functions >= 31) {
        EXPECT_LT(point.displacement_error, 0.1 * far);
      }
  }
}

TEST(CompareStart, IsSaidInTheRecordAndRefusedWhereItDoesNotFit) {
  ComparisonOptions options = brief(3.0);
  EXPECT_EQ(value_of<std::string>(compare_bases(response_with(), options).summary, "solves_begin_with"),
            "no_contact");
  options.start = start_of(three_motions(), "motion_0.18Hz_1.csv");
  const ComparisonRecord record = compare_bases(response_with(), options);
  EXPECT_EQ(value_of<std::string>(record.summary, "solves_begin_with"), "reference");
  EXPECT_NE(record.text.find("Each solve begins with the motion of the reference."), std::string::npos);
  Scene to_tolerance = response_with();
  to_tolerance.time.tolerance = 1e-3;  // which has no effect in comparisons, and so does not hinder a start
  EXPECT_NO_THROW(check_comparison(to_tolerance, options));
  options.start.contacts.displacement = options.start.contacts.force = Eigen::MatrixXd::Zero(3, 8);
  EXPECT_THROW(check_comparison(response_with(), options), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::app
