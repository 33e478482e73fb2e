// analysis.isolas: curves of an oscillator with a stop beside the one that a sweep follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/run_words.hpp"
#include "support/curve_record.hpp"
#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::app {
namespace {

/// A stop of 4 N/m and 0.15 N, from above: the curve without contact is followed down to 0.18 Hz, between the
/// folds at 0.1699 and 0.1957 Hz, where two other motions exist.
std::vector<std::string> from_above(std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {"contact.stiffness=4.0", "forcing.amplitude=0.15", "analysis.frequency_from=0.24",
               "analysis.frequency_to=0.18", "analysis.isola_spacing=0.02"});
  return more;
}

std::string sentences_of(const Record& record) {
  std::string text;
  for (const std::string& sentence : outcome_sentences(record.summary, 1.0, record.axis))
    text += sentence + " ";
  return text;
}

double column_extreme(const Table& table, const char* column, bool largest) {
  const std::vector<double> values = table.numbers(column);
  return largest ? *std::max_element(values.begin(), values.end())
                 : *std::min_element(values.begin(), values.end());
}

TEST(Isolas, AreCurvesThatTheSweepDoesNotPass) {
  const Record record = analyse(stop_with(from_above({"analysis.isolas=true"})));
  EXPECT_TRUE(record.converged);
  ASSERT_EQ(record.warnings.size(), 1u);
  EXPECT_NE(record.warnings.front().find("No contact closes"), std::string::npos);
  const auto isolas = value_of<Table>(record.summary, "isolas");
  ASSERT_EQ(isolas.rows(), 1u);
  EXPECT_EQ(cell_text(isolas.at(0, "status")), "returned");
  EXPECT_NEAR(isolas.numbers("lowest_frequency_Hz")[0], 0.18, 1e-9);
  const auto special = value_of<Table>(record.summary, "special_points_of_isolas").where("type", "fold");
  ASSERT_EQ(special.rows(), 1u);
  // The same fold on the curve from below, which holds both parts.
  const auto whole = value_of<Table>(
      analyse(stop_with({"contact.stiffness=4.0", "forcing.amplitude=0.15", "analysis.frequency_to=0.24"}))
          .summary,
      "special_points");
  EXPECT_NEAR(special.numbers("frequency_Hz")[0],
              column_extreme(whole.where("type", "fold"), "frequency_Hz", true), 1e-6);
  const Table main = record.sweep.where("isola", "0"), beside = record.sweep.where("isola", "1");
  EXPECT_EQ(main.rows() + beside.rows(), record.sweep.rows());
  EXPECT_LT(column_extreme(main, "max_displacement_m", true), 1.0);
  EXPECT_GT(column_extreme(beside, "max_displacement_m", true), 1.5);
  EXPECT_GT(column_extreme(beside, "unstable", true), 0.0);
  EXPECT_EQ(column_extreme(beside, "unstable", false), 0.0);
  EXPECT_EQ(value_of<std::string>(record.summary, "other_motions"), "sought");
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "isola_frequencies"), 3);
  EXPECT_NE(sentences_of(record).find("isola 1 from 0.18 to 0.19569 Hz"), std::string::npos)
      << sentences_of(record);
}

/// A load of 2 N at three times the frequency, whose curve has no contact: a motion of three of its periods
/// is on a closed curve, one motion for each of the periods in which it may begin.
std::string third_order_scene() {
  std::string text = stop_scene;
  text.insert(text.find("[time]"), "[[forcing.terms]]\nharmonic = 3\namplitude = 2.0\n");
  return text;
}

TEST(Isolas, AreClosedCurves) {
  const std::string text = third_order_scene();
  const std::vector<std::string> forced{"contact.stiffness=4.0", "forcing.amplitude=0.0"};
  std::vector<std::string> sweep = forced;
  for (const char* one :
       {"analysis.isolas=true", "analysis.isola_starts=6", "analysis.isola_spacing=0.0175",
        "time.quadrature_points=504", "analysis.frequency_from=0.165", "analysis.frequency_to=0.2"})
    sweep.emplace_back(one);
  const Record record = analyse(parse_scene(text, "third.toml", sweep));
  EXPECT_TRUE(record.converged);
  const auto isolas = value_of<Table>(record.summary, "isolas");
  ASSERT_EQ(isolas.rows(), 1u);
  EXPECT_EQ(cell_text(isolas.at(0, "status")), "closed");
  const auto folds = value_of<Table>(record.summary, "special_points_of_isolas").where("type", "fold");
  ASSERT_EQ(folds.rows(), 2u);
  // Of the motions by phases at 0.18 Hz all that touch are on it.
  std::vector<std::string> at = forced;
  at.emplace_back("forcing.frequency=0.18");
  const std::string there =
      text.substr(0, text.find("[time]")) + "[analysis]\ntype = \"motions\"\nrandom_starts = 4\n";
  const auto motions = value_of<Table>(analyse(parse_scene(there, "motions.toml", at)).summary, "motions");
  const Table closed = record.sweep.where("isola", "1");
  const std::vector<double> frequency = closed.numbers("frequency_Hz"),
                            force = closed.numbers("max_contact_force_N");
  int touching = 0;
  for (const double exact : motions.numbers("max_contact_force_N")) {
    if (exact == 0.0) continue;
    ++touching;
    double nearest = 1e300;
    for (std::size_t i = 1; i < frequency.size(); ++i) {
      const double share = (0.18 - frequency[i - 1]) / (frequency[i] - frequency[i - 1]);
      if (share < 0.0 || share > 1.0) continue;
      nearest = std::min(nearest, std::abs(force[i - 1] + share * (force[i] - force[i - 1]) - exact));
    }
    EXPECT_LT(nearest, 2e-2 * exact);
  }
  EXPECT_GE(touching, 1);
}

// An oscillator with a stop from above its folds: the exact curve is that of the test before, and the other
// one is followed exactly, too.
TEST(Isolas, OfExactCurvesAreExact) {
  const Record record = analyse(stop_with(from_above({"analysis.isolas=true", "analysis.exact=true"})));
  EXPECT_TRUE(record.converged) << record.status;
  const auto isolas = value_of<Table>(record.summary, "isolas");
  ASSERT_EQ(isolas.rows(), 1u);
  EXPECT_EQ(cell_text(isolas.at(0, "status")), "returned");
  const auto folds = value_of<Table>(record.summary, "special_points_of_isolas").where("type", "fold");
  ASSERT_EQ(folds.rows(), 1u);
  EXPECT_NEAR(folds.numbers("frequency_Hz")[0], 0.195690553549, 1e-11);
}

TEST(Isolas, OfExactCurvesMayBeClosed) {
  const std::vector<std::string> settings{
      "contact.stiffness=4.0",         "forcing.amplitude=0.0",         "analysis.isolas=true",
      "analysis.isola_starts=6",       "analysis.isola_spacing=0.0175", "time.quadrature_points=504",
      "analysis.frequency_from=0.165", "analysis.frequency_to=0.2",     "analysis.exact=true"};
  const Record record = analyse(parse_scene(third_order_scene(), "third.toml", settings));
  EXPECT_TRUE(record.converged) << record.status;
  const auto isolas = value_of<Table>(record.summary, "isolas");
  ASSERT_EQ(isolas.rows(), 1u);
  EXPECT_EQ(cell_text(isolas.at(0, "status")), "closed");
  EXPECT_EQ(value_of<Table>(record.summary, "special_points_of_isolas").where("type", "fold").rows(), 2u);
}

// The whole curve holds all motions, and nothing is found beside it.
TEST(Isolas, AreNoneWhereTheCurveHoldsAllMotions) {
  const Record record =
      analyse(stop_with({"analysis.isolas=true", "analysis.isola_spacing=0.03", "analysis.isola_starts=1"}));
  EXPECT_EQ(value_of<Table>(record.summary, "isolas").rows(), 0u);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "isola_frequencies"), 4);
  EXPECT_NE(sentences_of(record).find("None was found."), std::string::npos);
}

TEST(Isolas, ThatEndOnTheCurveSayThatAPartWasMissed) {
  Sweep sweep;
  sweep.curve.status = solvers::SweepStatus::reached_end;
  EXPECT_TRUE(sweep.converged());
  sweep.isolas.emplace_back().origin = {0.18, 0, false};
  EXPECT_EQ(sweep.status(), "reached_end");
  sweep.isolas.back().origin.meets_known = true;
  EXPECT_EQ(sweep.status(), "missed_part");
  EXPECT_FALSE(sweep.converged());
}

TEST(Isolas, NotSoughtAreSaidToBeSo) {
  const Record sweep = analyse(stop_with(from_above()));
  EXPECT_EQ(value_of<std::string>(sweep.summary, "other_motions"), "not_sought");
  EXPECT_EQ(find_entry(sweep.summary, "isolas"), nullptr);
  EXPECT_FALSE(sweep.sweep.has_column("isola"));
  EXPECT_NE(sentences_of(sweep).find("Motions that lie on no such curve were not sought."),
            std::string::npos);
  const Record stable = analyse(response_with());
  EXPECT_EQ(value_of<std::string>(stable.summary, "other_motions"), "not_sought");
  EXPECT_NE(sentences_of(stable).find("Other motions at this frequency were not sought."), std::string::npos);
  // Without contact there is one motion alone.
  std::string linear = stop_scene;
  const auto begin = linear.find("law = "), end = linear.find("[forcing]");
  const Record open =
      analyse(parse_scene(linear.replace(begin, end - begin, "law = \"none\"\n"), "linear.toml"));
  EXPECT_EQ(find_entry(open.summary, "other_motions"), nullptr);
}

TEST(Isolas, AreAnnouncedWithWhatTheyTake) {
  const std::string text = describe_scene(stop_with(from_above({"analysis.isolas=true"})));
  EXPECT_NE(text.find("sought at 3 frequencies, from rest and 4 random states each: 15 motions"),
            std::string::npos)
      << text;
}

TEST(Isolas, RefuseWhatDoesNotSettle) {
  const auto expect_parts = [](const std::vector<std::string>& overrides,
                               const std::vector<std::string>& parts) {
    const std::string text = message_of(stop_scene, overrides);
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_parts({"analysis.isolas=1"}, {"analysis.isolas = 1", "true or false"});
  expect_parts({"analysis.isolas=true", "analysis.subharmonic=2"},
               {"analysis.isolas = true", "analysis.subharmonic = 1"});
  expect_parts({"analysis.isolas=true", "structure.loss_factor=0.01", "structure.stiffness_damping=0"},
               {"analysis.isolas = true", "loss factor"});
  expect_parts({"analysis.isolas=true", "structure.elements=401"}, {"analysis.isolas = true", "at most 400"});
  expect_parts({"analysis.isola_spacing=0"}, {"analysis.isola_spacing = 0"});
  expect_parts({"analysis.isola_starts=-1"}, {"analysis.isola_starts = -1"});
  expect_parts({"analysis.isolas=true", "analysis.isola_spacing=1e-7"},
               {"analysis.isola_spacing = 1e-7", "at most 100000"});
  for (const std::string type : {"forced_response", "time_stepping"}) {
    const bool stepping = type == "time_stepping";
    const std::string text =
        message_of(stop_scene.substr(0, stop_scene.find(stepping ? "[time]" : "[analysis]")) +
                   "[analysis]\nisolas = true\ntype = \"" + type + "\"\n");
    EXPECT_NE(text.find("analysis.isolas = true"), std::string::npos) << text;
    EXPECT_NE(text.find("frequency_sweep"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace wavebalance::app
