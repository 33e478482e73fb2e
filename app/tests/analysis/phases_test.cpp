#include <gtest/gtest.h>

#include "support/bar_scene.hpp"
#include "support/curve_record.hpp"
#include "support/summary_value.hpp"
#include "support/two_masses.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

Record record_with_phases(std::vector<std::string> more) {
  more.emplace_back("analysis.phases=true");
  return analyse(scene_of(more), Observer());
}

TEST(PhasesOfAResponse, HoldTheInstantsOfContactAndTheErrorsOfTheResponse) {
  const Record coarse = record_with_phases({"time.functions=31", "time.quadrature_points=128"}),
               fine = record_with_phases({"time.functions=255", "time.quadrature_points=1024"});
  ASSERT_TRUE(coarse.converged && fine.converged);
  EXPECT_EQ(value_of<std::string>(coarse.summary, "phases_status"), "converged");
  EXPECT_GT(value_of<double>(coarse.summary, "error_of_displacement"),
            10.0 * value_of<double>(fine.summary, "error_of_displacement"));
  EXPECT_GT(value_of<double>(coarse.summary, "error_of_force"),
            value_of<double>(fine.summary, "error_of_force"));
  const Table phases = value_of<Table>(coarse.summary, "phases");
  const Table same = value_of<Table>(fine.summary, "phases");
  ASSERT_EQ(phases.rows(), same.rows());
  for (std::size_t i = 0; i < phases.rows(); ++i)
    for (const char* end : {"begin", "end"})
      EXPECT_NEAR(std::get<double>(phases.at(i, end)), std::get<double>(same.at(i, end)), 1e-8);
}

TEST(PhasesOfAResponse, HaveTheStabilityThatTheRecordNames) {
  const Record record = record_with_phases({});
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "phases");
}

TEST(PhasesOfAResponse, HaveTheStabilityOfTheStructureWhereThatOfTheBalanceIsAnother) {
  const TemporaryFolder folder;
  const auto place = two_masses_in(folder);
  const auto record_of = [&](const char* functions, const char* points, const char* phases,
                             const StartMotion& start = {}) {
    return analyse(load_scene(place, std::vector<std::string>{"time.functions=" + std::string(functions),
                                                              "time.quadrature_points=" + std::string(points),
                                                              "analysis.phases=" + std::string(phases)}),
                   AnalysisOptions{.start = start});
  };
  // One motion is settled to, and the others start from it.
  const Record settled = record_of("127", "512", "true");
  const StartMotion start = start_of(settled);
  const Record near = record_of("63", "512", "true", start), coarse = record_of("63", "512", "false", start),
               fine = record_of("1023", "8192", "false", start);
  ASSERT_TRUE(fine.converged) << fine.status;
  EXPECT_EQ(value_of<std::string>(coarse.summary, "stability"), "unstable");
  for (const Record* record : {&near, &settled}) {
    ASSERT_TRUE(record->converged) << record->status;
    const Summary& found = record->summary;
    EXPECT_EQ(value_of<std::string>(found, "phases_status"), "converged");
    EXPECT_EQ(value_of<Table>(found, "phases").rows(), 5u);
    EXPECT_EQ(value_of<std::string>(found, "stability"), "stable");
    for (const char* part : {"leading_multiplier_real", "leading_multiplier_imag"})
      EXPECT_NEAR(value_of<double>(found, part), value_of<double>(fine.summary, part), 1e-4) << part;
  }
}

TEST(PhasesOfAResponse, NameWhyTheyAreNotKnown) {
  const Record record = record_with_phases({"structure.loss_factor=0.02", "structure.stiffness_damping=0"});
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "structural_damping");
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "balance");
  EXPECT_EQ(value_of<Table>(record.summary, "phases").rows(), 0u);
}

TEST(PhasesOfAResponse, AreThoseOfARigidObstacleAtATipWithoutMass) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case1_rigid.toml",
                                 std::vector<std::string>{"analysis.phases=true"});
  const Record record = analyse(scene, Observer());
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "converged");
  EXPECT_LT(value_of<double>(record.summary, "error_of_displacement"), 1e-2);
  EXPECT_EQ(value_of<Table>(record.summary, "phases").rows(), 1u);
}

TEST(PhasesOfAResponse, AreThereUnlessTheSceneTurnsThemOff) {
  const Record usual = analyse(scene_of({}), Observer()),
               without = analyse(scene_of({"analysis.phases=false"}), Observer());
  ASSERT_TRUE(usual.converged && without.converged);
  EXPECT_EQ(value_of<std::string>(usual.summary, "phases_status"), "converged");
  EXPECT_EQ(value_of<std::string>(usual.summary, "stability_by"), "phases");
  EXPECT_GT(value_of<double>(usual.summary, "error_of_displacement"), 0.0);
  for (const char* name : {"phases_status", "phases", "error_of_displacement", "stability_by"})
    EXPECT_EQ(find_entry(without.summary, name), nullptr) << name;
}

TEST(PhasesOfAResponse, AreNotSoughtWithoutContact) {
  std::string text = bar_scene;
  const std::size_t from = text.find("law ="), to = text.find("[forcing]");
  text.replace(from, to - from, "law = \"none\"\n");
  const Scene scene = parse_scene(text, "bar.toml");
  const Record record = analyse(scene, Observer());
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(find_entry(record.summary, "phases_status"), nullptr);
}

// A contact a million times as stiff as the bar strikes some 1700 times in a period.
TEST(PhasesOfAResponse, TellTheErrorUpToTheirOwn) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/extremes/found_stiff.toml", {});
  const Record record = analyse(scene, Observer());
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "tolerance_missed");
  EXPECT_LT(value_of<double>(record.summary, "phases_estimated_error"), 1e-5);
  EXPECT_NEAR(value_of<double>(record.summary, "error_of_displacement"), 0.0190883, 1e-5);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "balance");
}

// What the panels of the phases do not resolve, the flow does.
TEST(PhasesOfAResponse, OfManyContactsAreFound) {
  const Scene scene = load_scene(WAVEBALANCE_SCENES "/matrices/cantilevers.toml", {});
  const Record record = analyse(scene, Observer());
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "converged");
  EXPECT_LT(value_of<double>(record.summary, "error_of_displacement"), 0.1);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "phases");
}

TEST(PhasesOfAResponse, AreRefusedForModes) {
  EXPECT_THROW(parse_scene(rod_scene, "rod.toml", std::vector<std::string>{"analysis.phases=true"}),
               SceneError);
}

}  // namespace
}  // namespace wavebalance::app
