// analysis.type = "motions": all motions of an oscillator with a stop at one frequency.
#include <gtest/gtest.h>

#include <cmath>

#include "report/run_words.hpp"
#include "support/curve_record.hpp"
#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

/// The oscillator with a stop.
const std::string motions_scene =
    stop_scene.substr(0, stop_scene.find("[time]")) + "[analysis]\ntype = \"motions\"\n";

/// A stop of 4 N/m and 0.15 N: two stable motions and one unstable one between the folds at 0.1699 and 0.1957
/// Hz.
Scene motions_with(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"contact.stiffness=4.0", "forcing.amplitude=0.15"});
  return parse_scene(motions_scene, "motions.toml", overrides);
}

/// A response of the same oscillator by a balance.
Scene balance_with(std::vector<std::string> more = {}) {
  for (const char* one : {"analysis.type=forced_response", "time.trial=fourier", "time.weight=fourier",
                          "time.functions=255", "time.quadrature_points=4096"})
    more.emplace_back(one);
  return motions_with(more);
}

TEST(Motions, BetweenTheFoldsAreTwoStableOnesAndOneUnstableOne) {
  const Record record = analyse(motions_with());
  EXPECT_TRUE(record.converged);
  EXPECT_TRUE(record.warnings.empty());
  const auto motions = value_of<Table>(record.summary, "motions");
  ASSERT_EQ(motions.rows(), 3u);
  int stable = 0;
  double shares = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_stable = cell_text(motions.at(i, "stability")) == "stable";
    stable += is_stable;
    const double share = motions.numbers("share")[i];
    shares += share;
    EXPECT_EQ(motions.numbers("share_error")[i], std::sqrt(share * (1.0 - share) / 24.0));
    EXPECT_EQ(share > 0.0, is_stable);
    EXPECT_EQ(motions.numbers("unstable_multipliers")[i], is_stable ? 0.0 : 1.0);
    const Table file = table_of(record, cell_text(motions.at(i, "file")));
    EXPECT_EQ(file.rows(), 1024u);
    EXPECT_NEAR(largest(file), motions.numbers("max_displacement_m")[i], 1e-12);
  }
  EXPECT_EQ(stable, 2);
  EXPECT_NEAR(shares, 1.0, 1e-15);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "random_starts"), 24);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "starts_without_motion"), 0);
  const std::vector<std::string> sentences = outcome_sentences(record.summary, 1.0);
  ASSERT_EQ(sentences.size(), 4u);
  EXPECT_EQ(sentences[1], "There are 3 motions, of which 2 are stable, from 24 random starts and rest.");
  EXPECT_EQ(sentences[2].find("not known"), std::string::npos);
}

TEST(Motions, BelowTheFoldsThereIsOne) {
  const Record record = analyse(motions_with({"forcing.frequency=0.14"}));
  const auto motions = value_of<Table>(record.summary, "motions");
  ASSERT_EQ(motions.rows(), 1u);
  EXPECT_EQ(motions.numbers("share")[0], 1.0);
  EXPECT_EQ(cell_text(motions.at(0, "found_by")), "rest");
}

/// The record of eight random starts.
Record eight_starts(const std::string& seed) {
  return analyse(motions_with({"analysis.seed=" + seed, "analysis.random_starts=8"}));
}

const Record& first_seed() {
  static const Record record = eight_starts("1");
  return record;
}

TEST(Motions, OfOneSeedAreTheSameTable) {
  const auto table = [](const Record& record) {
    return csv_text(value_of<Table>(record.summary, "motions"));
  };
  EXPECT_EQ(table(eight_starts("1")), table(first_seed()));
  EXPECT_NE(table(eight_starts("4")), table(first_seed()));
}

TEST(Motions, AreStartsOfResponsesAlsoTheUnstableOne) {
  const Record& record = first_seed();
  const auto motions = value_of<Table>(record.summary, "motions");
  ASSERT_EQ(motions.rows(), 3u);
  for (std::size_t i = 0; i < motions.rows(); ++i) {
    const Record response =
        analyse(balance_with(), AnalysisOptions{.start = start_of(record, cell_text(motions.at(i, "file")))});
    ASSERT_TRUE(response.converged) << response.status;
    EXPECT_LT(value_of<double>(response.summary, "start_distance"), 1e-4);
    EXPECT_EQ(value_of<std::string>(response.summary, "stability"), cell_text(motions.at(i, "stability")));
  }
}

// At 2.6 rad/s the motion of one period is unstable, and that of two is written over both of them.
TEST(Motions, OfTwoPeriodsAreWrittenWithTheirPeriod) {
  const std::vector<std::string> doubled{"structure.stiffness_damping=0.1", "contact.stiffness=10.0",
                                         "contact.gap=0.1", "forcing.amplitude=0.8",
                                         "forcing.frequency=0.4138028520389279"};
  std::vector<std::string> few = doubled;
  few.emplace_back("analysis.random_starts=2");
  const Record record = analyse(motions_with(few));
  const auto motions = value_of<Table>(record.summary, "motions");
  ASSERT_EQ(motions.rows(), 2u);
  EXPECT_EQ(motions.numbers("period")[0], 2.0);
  EXPECT_EQ(motions.numbers("period")[1], 1.0);
  const TemporaryFolder folder;
  for (const RecordFile& file : record.files) folder.write(file.name, file.contents);
  folder.write("summary.json", json_text(record.summary));
  const StartMotion start = read_start_motion(folder / "motion_1.csv");
  EXPECT_EQ(start.periods, 2);
  EXPECT_EQ(read_start_motion(folder / "motion_2.csv").periods, 1);
  std::vector<std::string> two = doubled;
  two.emplace_back("analysis.subharmonic=2");
  const Record response = analyse(balance_with(two), AnalysisOptions{.start = start});
  ASSERT_TRUE(response.converged) << response.status;
  EXPECT_LT(value_of<double>(response.summary, "start_distance"), 1e-3);
  EXPECT_EQ(value_of<std::int64_t>(response.summary, "period_of_motion"), 2);
}

TEST(Motions, ThatRepeatTooLateAreCountedAndWarnedOf) {
  const Record record =
      analyse(motions_with({"structure.stiffness_damping=0.1", "contact.stiffness=10.0", "contact.gap=0.1",
                            "forcing.amplitude=0.8", "forcing.frequency=0.4138028520389279",
                            "analysis.longest_period=1", "analysis.random_starts=2"}));
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "starts_without_motion"), 2);
  ASSERT_EQ(record.warnings.size(), 1u);
  EXPECT_NE(record.warnings[0].find("2 of 2 random starts"), std::string::npos);
}

TEST(Motions, RefuseKeysByTheirNames) {
  EXPECT_EQ(error_of(motions_scene, {"analysis.random_starts=-1"}).key, "analysis.random_starts");
  EXPECT_EQ(error_of(motions_scene, {"analysis.longest_period=0"}).key, "analysis.longest_period");
  EXPECT_EQ(error_of(motions_scene, {"analysis.seed=-1"}).key, "analysis.seed");
  EXPECT_EQ(error_of(motions_scene, {"analysis.subharmonic=2"}).key, "analysis.subharmonic");
  EXPECT_EQ(error_of(motions_scene, {"structure.loss_factor=0.1"}).key, "structure.loss_factor");
  EXPECT_EQ(error_of(motions_scene, {"structure.elements=401"}).key, "structure.elements");
  EXPECT_EQ(error_of(motions_scene, {"analysis.type=time_stepping", "analysis.seed=1"}).key, "analysis.seed");
}

TEST(Motions, RefuseARigidContactWithMass) {
  std::string rigid = motions_scene;
  rigid.replace(rigid.find("law = \"linear\"\nstiffness = 2.0"), 30, "law = \"rigid\"\nmass = \"keep\"");
  EXPECT_EQ(error_of(rigid).key, "contact.mass");
}

TEST(Motions, OfAWrittenSceneAreReadAgain) {
  const Scene scene = motions_with({"analysis.seed=7", "analysis.longest_period=3"});
  EXPECT_EQ(parse_scene(write_scene(scene), "written.toml"), scene);
  EXPECT_NE(describe_scene(scene).find("up to 3 periods"), std::string::npos);
}

}  // namespace
}  // namespace wavebalance::app
