#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <regex>
#include <thread>

#include "support/brief_comparison.hpp"
#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

Outcome compare(const TemporaryFolder& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments{"compare", folder.write("case.toml", bar_scene), "--output",
                                     folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(folder, std::move(arguments));
}

TEST(CommandCompare, WritesItsFilesAndSaysWhatToTake) {
  const TemporaryFolder folder;
  const std::string budget = std::to_string(2 * slowness);
  const Outcome outcome = compare(folder, {"--pairs", "fourier:fourier,haar:fourier", "--budget", budget});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name :
       {"summary.json", "comparison.csv", "comparison.md", "error_over_time.svg", "error_over_functions.svg",
        "scene.toml", "report.html", "error_over_time.figure.js", "error_over_functions.figure.js"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 9);
  const std::string page = read_file(folder / "out" / "report.html");
  for (const std::string& part :
       {std::string("For an error of 1e-4 of displacement and force"), std::string("[time]\ntrial = "),
        std::string("Errors are those against contact phases."), std::string("How each pair did"),
        std::string("Its motion is stable."), std::string("error_over_time.figure.js"),
        std::string("wavebalance compare "),
        "fourier:fourier,haar:fourier <span class=\"whole\">--budget</span> " + budget})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_NE(outcome.output.find("The reference is contact phases"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("For an error of 1e-2 of displacement and force the cheapest is "),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("[time]\ntrial = \""), std::string::npos) << outcome.output;
  const Table table = read_csv(folder / "out" / "comparison.csv");
  EXPECT_GT(table.where("trial", "haar").rows(), 4u);
  EXPECT_GT(table.where("on_front", "true").rows(), 2u);
  const Table phases = table.where("trial", "phases");
  EXPECT_GE(phases.where("converged", "true").rows(), 2u);
  EXPECT_NE(read_file(folder / "out" / "error_over_time.svg").find("contact phases"), std::string::npos);
  const std::string summary = read_file(folder / "out" / "summary.json");
  EXPECT_NE(summary.find("\"budget_seconds\": " + budget + ".0"), std::string::npos);
  for (const char* part : {"\"converged\": true", "\"reference\": \"phases\"", "\"time_table\": \"[time]",
                           "\"basis_matters\": ", "\"fourier_time_ratio\": "})
    EXPECT_NE(summary.find(part), std::string::npos) << part;
  EXPECT_EQ(load_scene(folder / "out" / "scene.toml"), load_scene(folder / "case.toml"));
}

TEST(CommandCompare, LeavesTheReportOutAndSaysWhichPairsAreNone) {
  const TemporaryFolder folder;
  ASSERT_EQ(compare(folder, {"--budget", "1"}).exit_code, 0);
  EXPECT_NE(read_file(folder / "out" / "report.html").find("Not admissible"), std::string::npos);
  const Outcome without =
      compare(folder, {"--pairs", "fourier:fourier", "--budget", "1", "--no-report", "--quiet"});
  EXPECT_EQ(without.exit_code, 0) << without.errors;
  EXPECT_FALSE(fs::exists(folder / "out" / "report.html"));
  EXPECT_FALSE(fs::exists(folder / "out" / "error_over_time.figure.js"));
  EXPECT_TRUE(fs::exists(folder / "out" / "error_over_time.svg"));
}

TEST(CommandCompare, OfASweepDrawsTheCurvesOverEachOther) {
  const TemporaryFolder folder;
  const Outcome outcome =
      compare(folder, {"--pairs", "fourier:fourier,bspline:bspline", "--budget", "2", "--set",
                       "analysis.type=frequency_sweep", "--set", "analysis.frequency_from=100", "--set",
                       "analysis.frequency_to=110"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name : {"summary.json", "comparison.csv", "comparison.md", "sweeps.svg", "scene.toml",
                           "report.html", "sweeps.figure.js"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_NE(read_file(folder / "out" / "report.html").find("distance from the finest"), std::string::npos);
  const Table table = read_csv(folder / "out" / "comparison.csv");
  EXPECT_GT(table.where("status", "reached_end").rows(), 2u);
}

TEST(CommandCompare, WrongPairsBudgetsKeysAndAnalysesAreTwoAndNameWhatIsAllowed) {
  struct Wrong {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Wrong> wrong{
      {{"--pairs", "haar:haar"}, "wavebalance: --pairs haar:haar: not an admissible pair: "},
      {{"--pairs", "harr:fourier"}, "\"harr\" is no basis; expected \"fourier\", \"haar\""},
      {{"--pairs", "haar"}, "\"haar\" is no pair; expected TRIAL:WEIGHT"},
      {{"--budget", "0"}, "wavebalance: --budget 0: expected seconds > 0\n"},
      {{"--budget", "soon"}, "--budget"},
      {{"--error", "energy"}, "wavebalance: --error energy: expected displacement, force or both\n"},
      {{"--threads", "two"}, "--threads: \"two\": expected a whole number from 0 to 1024; 0: one per core"},
      {{"--threads", "-1"}, "--threads: \"-1\": expected a whole number from 0 to 1024"},
      {{"--threads", "1025"}, "--threads: \"1025\": expected a whole number from 0 to 1024"},
      {{"--set", "contact.gab=1"}, "unknown key; did you mean contact.gap?"},
      {{"--set", "analysis.type=time_stepping"},
       "analysis.type = \"time_stepping\": pairs of bases are compared"},
  };
  for (const Wrong& one : wrong) {
    const TemporaryFolder folder;
    const Outcome outcome = compare(folder, one.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << one.message;
    EXPECT_NE(outcome.errors.find(one.message), std::string::npos) << outcome.errors;
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(CommandCompare, WithoutAReferenceIsThreeWithTheRecord) {
  const TemporaryFolder folder;
  const Outcome outcome = compare(folder, {"--budget", "1e-6"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_NE(outcome.errors.find("nothing to compare with (no_reference)"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"converged\": false"), std::string::npos);
}

TEST(CommandCompare, ReplacesNoFileThatNoRecordListsAndNotItsScene) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", bar_scene);
  const Outcome own = run(folder, {"compare", scene, "--output", folder.path()});
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_NE(own.errors.find("scene.toml: is read by this command"), std::string::npos) << own.errors;
  std::filesystem::create_directory(folder / "out");
  folder.write("out/comparison.md", "notes\n");
  const Outcome foreign = run(folder, {"compare", scene, "--output", folder / "out"});
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.errors.find("comparison.md: would be replaced"), std::string::npos) << foreign.errors;
  EXPECT_EQ(read_file(folder / "out" / "comparison.md"), "notes\n");
}

TEST(CommandCompare, InterruptedWritesWhatWasMeasuredSoFar) {
  const TemporaryFolder folder;
  Terminal terminal;
  Command command(
      folder,
      {"compare", folder.write("case.toml", bar_scene), "--output", folder / "out", "--budget", "600"},
      WAVEBALANCE_COMMAND, &terminal);
  for (int i = 0; i < 1200 && terminal.text().find(" functions") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(300 * (slowness - 1)));  // until one is measured
  command.send(SIGINT);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the record holds what was measured so far"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"status\": \"interrupted\""),
            std::string::npos);
  EXPECT_GT(read_csv(folder / "out" / "comparison.csv").rows(), 1u);
}

TEST(CommandCompare, OfSweepsOnTwoThreadsInterruptedWritesWhatWasMeasuredSoFar) {
  const TemporaryFolder folder;
  Terminal terminal;
  Command command(folder,
                  {"compare", folder.write("case.toml", bar_scene), "--output", folder / "out", "--budget",
                   "600", "--threads", "2", "--set", "analysis.type=frequency_sweep", "--set",
                   "analysis.frequency_from=100", "--set", "analysis.frequency_to=110"},
                  WAVEBALANCE_COMMAND, &terminal);
  // Small problems take less than the time until the signal arrives, which may then be between two curves.
  const std::regex within_a_curve("[0-9]{3} functions: step [0-9][0-9]");
  for (int i = 0; i < 1200 && !std::regex_search(terminal.text(), within_a_curve); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  command.send(SIGINT);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"status\": \"interrupted\""),
            std::string::npos);
  const Table table = read_csv(folder / "out" / "comparison.csv");
  EXPECT_GT(table.where("status", "reached_end").rows(), 1u);
  EXPECT_GE(table.where("status", "interrupted").rows(), 1u);
}

}  // namespace
