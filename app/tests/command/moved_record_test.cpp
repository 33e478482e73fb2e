// Records that can be moved: names of files relative to the record, or copies of them in it.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/chain_files.hpp"
#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

/// A project: a scene with its matrices in a folder of their own.
class Project : public testing::Test {
 protected:
  Project() {
    fs::create_directories(project_ / "data");
    write("data/k.mtx", chain_stiffness);
    write("data/m.mtx", chain_mass);
    write("data/f.mtx", chain_load);
    write("case.toml",
          with(with(with(chain_scene, "\"m.mtx\"", "\"data/m.mtx\""), "\"k.mtx\"", "\"data/k.mtx\""),
               "load_dofs = [3]", "load = \"data/f.mtx\""));
  }
  void write(const std::string& name, const std::string& text) const { write_file(project_ / name, text); }
  Outcome solve(const std::string& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run", (project_ / "case.toml").string(), "--output",
                                       (project_ / output).string(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(folder_, arguments);
  }

  TemporaryFolder folder_;
  fs::path project_ = folder_ / "project";
};

TEST_F(Project, IsMovedWithItsRecords) {
  ASSERT_EQ(solve("results/a").exit_code, 0);
  const std::string text = read_file(project_ / "results/a/scene.toml");
  EXPECT_NE(text.find("mass = \"../../data/m.mtx\""), std::string::npos) << text;
  EXPECT_EQ(read_file(project_ / "results/a/report.html").find(folder_.path().string() + "/project/data"),
            std::string::npos);
  fs::rename(project_, folder_ / "elsewhere");
  EXPECT_EQ(load_scene(folder_ / "elsewhere/results/a/scene.toml").forcing.frequency, 50.0);
}

TEST_F(Project, GivesARecordWithCopiesThatStandsAlone) {
  const Outcome outcome = solve("a", {"--copy-inputs"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(read_file(project_ / "a/input_m.mtx"), chain_mass);
  fs::rename(project_ / "a", folder_ / "sent");
  fs::remove_all(project_);
  const Scene scene = load_scene(folder_ / "sent/scene.toml");
  EXPECT_EQ(scene.structure.matrices.stiffness, (folder_ / "sent/input_k.mtx").string());
  const Outcome again =
      run(folder_, {"run", (folder_ / "sent/scene.toml").string(), "--output", (folder_ / "b").string()});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
}

TEST_F(Project, GivesAComparisonThatStandsAlone) {
  const Outcome outcome =
      run(folder_, {"compare", (project_ / "case.toml").string(), "--output", (project_ / "c").string(),
                    "--quiet", "--budget", "0.2", "--pairs", "fourier:fourier", "--copy-inputs"});
  ASSERT_NE(outcome.exit_code, 2) << outcome.errors;  // 3: the time was too short for a reference
  fs::rename(project_ / "c", folder_ / "sent");
  fs::remove_all(project_);
  EXPECT_EQ(load_scene(folder_ / "sent/scene.toml").structure.matrices.stiffness,
            (folder_ / "sent/input_k.mtx").string());
}

TEST_F(Project, KeepsCopiesOfOneNameApart) {
  fs::create_directories(project_ / "other");
  write("other/m.mtx", chain_stiffness);
  ASSERT_EQ(solve("a", {"--copy-inputs", "--set", "structure.stiffness=other/m.mtx"}).exit_code, 0);
  EXPECT_EQ(read_file(project_ / "a/input_m.mtx"), chain_mass);
  EXPECT_EQ(read_file(project_ / "a/input_2_m.mtx"), chain_stiffness);
}

TEST_F(Project, ReplacesTheCopiesOfAnEarlierRecordAndNoOtherFile) {
  ASSERT_EQ(solve("a", {"--copy-inputs"}).exit_code, 0);
  ASSERT_EQ(solve("a").exit_code, 0);
  EXPECT_FALSE(fs::exists(project_ / "a/input_m.mtx"));
  fs::create_directories(project_ / "b");
  write("b/input_m.mtx", "mine");
  const Outcome refused = solve("b", {"--copy-inputs"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(read_file(project_ / "b/input_m.mtx"), "mine");
}

}  // namespace
