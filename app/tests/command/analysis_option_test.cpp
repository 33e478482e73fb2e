// --analysis: another analysis of a scene, without the keys that do not belong to it.
#include <gtest/gtest.h>

#include "support/chain_files.hpp"
#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/other_analysis.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance::app;

const std::string sweep_lines =
    "type = \"frequency_sweep\"\nfrequency_from = 40.0\nfrequency_to = 60.0\nmotion_at = \"peak\"\n"
    "motion_points = 8\nlargest_step = 0.5";

std::string sweep_scene() {
  return with(with(chain_scene, "type = \"forced_response\"", sweep_lines), "[time]",
              "[[forcing.terms]]\nharmonic = 0\namplitude = 3.0\n[time]");
}

TEST(AnalysisOption, LeavesOutTheKeysOfASweepForAResponse) {
  const TemporaryFolder folder;
  write_chain(folder);
  const auto scene = folder.write("case.toml", sweep_scene());
  EXPECT_EQ(keys_beside_analysis(scene, "forced_response"),
            (std::vector<std::string>{"analysis.frequency_from", "analysis.frequency_to",
                                      "analysis.motion_at", "analysis.largest_step"}));
  const Outcome outcome = run(folder, {"run", scene.string(), "--output", (folder / "out").string(),
                                       "--analysis", "forced_response"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("left out for analysis.type = \"forced_response\": analysis.frequency_from"),
            std::string::npos)
      << outcome.errors;
  EXPECT_EQ(load_scene(folder / "out" / "scene.toml").analysis.type, AnalysisType::forced_response);
}

TEST(AnalysisOption, LeavesOutDampingAndLoadsForANonlinearMode) {
  const TemporaryFolder folder;
  write_chain(folder);
  const auto scene = folder.write("case.toml", sweep_scene());
  const Outcome outcome = run(folder, {"check", scene.string(), "--analysis", "nonlinear_mode"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name : {"structure.modal_damping", "forcing.terms", "analysis.motion_at"})
    EXPECT_NE(outcome.errors.find(name), std::string::npos) << outcome.errors;
}

TEST(AnalysisOption, KeepsWhatIsSetBesideIt) {
  const TemporaryFolder folder;
  write_chain(folder);
  const auto scene = folder.write("case.toml", chain_scene);
  const Outcome outcome = run(folder, {"check", scene.string(), "--analysis", "frequency_sweep", "--set",
                                       "analysis.frequency_from=40", "--set", "analysis.frequency_to=60"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("40 to 60 Hz"), std::string::npos) << outcome.output;
}

TEST(AnalysisOption, NamesTheAnalysesThatThereAre) {
  const TemporaryFolder folder;
  write_chain(folder);
  const auto scene = folder.write("case.toml", chain_scene);
  const Outcome outcome = run(folder, {"check", scene.string(), "--analysis", "response"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("--analysis response"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("\"forced_response\""), std::string::npos) << outcome.errors;
}

TEST(UnsetOption, TakesAllTermsByOneName) {
  const TemporaryFolder folder;
  write_chain(folder);
  const std::vector<std::string> removed{"forcing.terms"};
  const Scene scene = parse_scene(sweep_scene(), (folder / "case.toml").string(), {}, removed);
  EXPECT_TRUE(scene.forcing.terms.empty());
}

TEST(LargestStep, IsFollowedByTheFirstOne) {
  const TemporaryFolder folder;
  write_chain(folder);
  const std::vector<std::string> small{"analysis.largest_step=0.001"};
  const Scene scene = parse_scene(sweep_scene(), (folder / "case.toml").string(), small);
  EXPECT_EQ(scene.analysis.first_step, 0.001);
}

}  // namespace
