#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

const std::string small_study = R"(scene = "bar.toml"
set = ["time.functions=15", "time.quadrature_points=64"]
[[parameters]]
key = "forcing.frequency"
from = 120
to = 160
count = 5
[[parameters]]
key = "forcing.amplitude"
values = [150e3, 250e3]
)";

Outcome study(const TemporaryFolder& folder, const std::string& text, std::vector<std::string> more = {}) {
  folder.write("bar.toml", bar_scene);
  std::vector<std::string> arguments{"study", folder.write("study.toml", text), "--output", folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(folder, std::move(arguments));
}

TEST(CommandStudy, WritesARowPerRunAPictureAndAPage) {
  const TemporaryFolder folder;
  const Outcome outcome = study(folder, small_study);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name :
       {"study.csv", "study.npz", "study.svg", "summary.json", "report.html", "scene.toml", "study.journal"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_NE(outcome.output.find("10 of 10 runs have ended, and 10 of them converged."), std::string::npos);
  const Table table = read_csv(folder / "out" / "study.csv");
  ASSERT_EQ(table.rows(), 10u);
  EXPECT_EQ(table.numbers("run").back(), 10.0);
  EXPECT_EQ(table.numbers("forcing.amplitude")[1], 250e3);
  const std::string page = read_file(folder / "out" / "report.html");
  for (const char* part :
       {"10 of 10 runs have ended", "wavebalance study ", "Quantiles", "max_displacement_m"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"quantiles\""), std::string::npos);
}

TEST(CommandStudy, ARunHasTheValuesOfTheCommandRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(study(folder, small_study).exit_code, 0);
  const Table table = read_csv(folder / "out" / "study.csv");
  const Outcome alone = run(folder, {"run", folder / "bar.toml", "--output", folder / "alone", "--set",
                                     "time.functions=15", "--set", "time.quadrature_points=64", "--set",
                                     "forcing.frequency=130", "--set", "forcing.amplitude=250e3"});
  ASSERT_EQ(alone.exit_code, 0) << alone.errors;
  EXPECT_NE(read_file(folder / "alone" / "summary.json")
                .find("\"max_displacement_m\": " + cell_text(table.at(3, "max_displacement_m")) + ","),
            std::string::npos);
}

TEST(CommandStudy, ARunThatDoesNotConvergeIsThreeAndThePageNamesTheCommandThatRepeatsIt) {
  const TemporaryFolder folder;
  const Outcome outcome =
      study(folder, "scene = \"bar.toml\"\n[[parameters]]\nkey = \"time.functions\"\nvalues = [15, 0, 31]\n");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_NE(outcome.output.find("refused               1"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("\nconverged"), std::string::npos)
      << outcome.output;  // the line before says it
  const std::string page = read_file(folder / "out" / "report.html");
  EXPECT_NE(page.find("--set</span> time.functions=0 <span class=\"whole\">--output</span> run2"),
            std::string::npos);
}

TEST(CommandStudy, WrongStudiesAndOptionsAreTwoAndNothingIsWritten) {
  struct Wrong {
    std::string text;
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Wrong> wrong{
      {"scene = \"none.toml\"\n" + small_study.substr(19), {}, "none.toml: cannot be read"},
      {small_study + "vallues = 3\n",
       {},
       "study.toml:11: parameters[2].vallues = 3: unknown key; did you mean values?"},
      {small_study, {"--threads", "-1"}, "--threads: \"-1\": expected a whole number from 0 to 1024"},
      {small_study, {"--threads", "100000"}, "--threads: \"100000\": expected a whole number from 0 to 1024"},
      {small_study, {"--thread", "1"}, "did you mean --threads?"},
  };
  for (const Wrong& one : wrong) {
    const TemporaryFolder folder;
    const Outcome outcome = study(folder, one.text, one.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << one.message;
    EXPECT_NE(outcome.errors.find(one.message), std::string::npos) << outcome.errors;
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(CommandStudy, ItsSceneAndFilesThatNoRecordListsAreNotReplaced) {
  const TemporaryFolder folder;
  folder.write("scene.toml", bar_scene);
  const std::string text = "scene = \"scene.toml\"\n" + small_study.substr(19);
  const std::string file = folder.write("study.toml", text);
  const Outcome own = run(folder, {"study", file, "--output", folder.path()});
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_NE(own.errors.find("scene.toml: is read by this command"), std::string::npos) << own.errors;
  EXPECT_FALSE(fs::exists(folder / "study.journal"));
  fs::create_directory(folder / "out");
  folder.write("out/study.csv", "measured\n");
  const Outcome foreign = run(folder, {"study", file, "--output", folder / "out"});
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.errors.find("study.csv: would be replaced"), std::string::npos) << foreign.errors;
  EXPECT_EQ(read_file(folder / "out" / "study.csv"), "measured\n");
}

TEST(CommandStudy, AnotherStudyInTheSameFolderIsRefusedAndTheFirstStays) {
  const TemporaryFolder folder;
  ASSERT_EQ(study(folder, small_study).exit_code, 0);
  const std::string before = read_file(folder / "out" / "study.csv");
  const Outcome outcome =
      study(folder, small_study + "# other\n[[parameters]]\nkey = \"contact.gap\"\nvalues = [1e-3]\n");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("belongs to another study or scene; name another folder"), std::string::npos)
      << outcome.errors;
  EXPECT_EQ(read_file(folder / "out" / "study.csv"), before);
}

/// A study of a second or more, killed by `signal` once its journal has rows.
Outcome killed_study(const TemporaryFolder& folder, int signal) {
  folder.write("bar.toml", bar_scene);
  folder.write("long.toml",
               "scene = \"bar.toml\"\nset = [\"time.functions=127\", \"time.quadrature_points=4096\"]\n"
               "[[parameters]]\nkey = \"forcing.frequency\"\nfrom = 120\nto = 160\ncount = 3000\n");
  Command command(folder, {"study", folder / "long.toml", "--output", folder / "out", "--threads", "1"},
                  WAVEBALANCE_COMMAND);
  const fs::path journal = folder / "out" / "study.journal";
  std::error_code ignored;
  for (int i = 0; i < 2000 && !(fs::exists(journal, ignored) && fs::file_size(journal, ignored) > 8000); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  command.send(signal);
  return command.wait();
}

TEST(CommandStudy, InterruptedWritesTheRunsSoFarAndGoesOn) {
  const TemporaryFolder folder;
  const Outcome outcome = killed_study(folder, SIGINT);
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the same command goes on from here"), std::string::npos) << outcome.errors;
  const std::size_t rows = read_csv(folder / "out" / "study.csv").rows();
  EXPECT_GT(rows, 1u);
  EXPECT_LT(rows, 3000u);
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"status\": \"interrupted\""),
            std::string::npos);
}

TEST(CommandStudy, KilledKeepsItsRowsInTheJournal) {
  const TemporaryFolder folder;
  EXPECT_EQ(killed_study(folder, SIGKILL).exit_code, -SIGKILL);
  EXPECT_FALSE(fs::exists(folder / "out" / "study.csv"));
  const Command again(folder, {"study", folder / "long.toml", "--output", folder / "out", "--threads", "1"},
                      WAVEBALANCE_COMMAND);
  for (int i = 0; i < 2000 && read_file(folder / "stderr").find("are there already") == std::string::npos;
       ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  again.send(SIGKILL);
  EXPECT_NE(read_file(folder / "stderr").find(" of 3000 runs are there already"), std::string::npos);
}

}  // namespace
