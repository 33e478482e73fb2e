#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "support/chain_files.hpp"
#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

TEST(CommandRun, SolvesAndWritesEverything) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  for (const char* name : {"report.html", "summary.json", "response.csv", "response.svg",
                           "response.figure.js", "response.motion.js", "scene.toml"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 7);
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"converged\": true"), std::string::npos);
  EXPECT_EQ(read_csv(folder / "out" / "response.csv").rows(), 1024u);
  EXPECT_EQ(read_file(folder / "out" / "response.csv").find("time_fraction,displacement_m,"), 0u);
  const std::string summary = read_file(folder / "out" / "summary.json");
  EXPECT_NE(summary.find("\"name\": \"response.csv\""), std::string::npos) << summary;
  EXPECT_EQ(load_scene(folder / "out" / "scene.toml"), load_scene(scene));
}

TEST(CommandRun, QuietSaysNothing) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", bar_scene), "-o", folder / "out", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output + outcome.errors, "");
}

TEST(CommandRun, WarnsOfAConditionPast1e12AlsoWhenQuiet) {
  const TemporaryFolder folder;
  const fs::path scene = fs::path(WAVEBALANCE_SCENES) / "extremes" / "bar_linear.toml";
  // A part in 1e12 above the bar's first natural frequency.
  const std::string near_resonance = "forcing.frequency=1273.14709322245";
  const Outcome outcome =
      run(folder, {"run", scene, "-o", folder / "out", "--quiet", "--set", "contact.gap=1e15", "--set",
                   "structure.stiffness_damping=0", "--set", near_resonance});
  EXPECT_NE(outcome.errors.find("wavebalance: warning: the condition estimate "), std::string::npos)
      << outcome.errors;
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"the condition estimate "), std::string::npos);
}

TEST(CommandRun, ToleranceChoosesTheSizesAndSaysHow) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", tolerance_scene("1e-3")), "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("estimated_error"), std::string::npos);
  const std::string summary = read_file(folder / "out" / "summary.json");
  for (const char* part :
       {"\"converged\": true", "\"tolerance\": 0.001", "\"estimated_error\": ", "\"ladder\": [",
        "\"trial\": \"fourier\"", "\"functions\": ", "\"quadrature_points\": ", "\"seconds\": "})
    EXPECT_NE(summary.find(part), std::string::npos) << part;
}

// A loss factor, so that phases do not apply, and contact that lasts, so that rounding ends the refinement.
TEST(CommandRun, ToleranceOutOfReachIsThree) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", tolerance_scene("1e-13")), "--output", folder / "out",
                   "--set", "contact.gap=-5e-3", "--set", "structure.loss_factor=0.2", "--set",
                   "structure.stiffness_damping=0"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_NE(outcome.errors.find("stagnated"), std::string::npos) << outcome.errors;
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"converged\": false"), std::string::npos);
}

TEST(CommandRun, OverridesAreInTheResults) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", bar_scene), "--output", folder / "out", "--set",
                   "time.trial=haar", "--set", "contact.gap=2e-3"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(load_scene(folder / "out" / "scene.toml").contact.gap, 2e-3);
  const std::string summary = read_file(folder / "out" / "summary.json");
  for (const char* part : {"case.toml\"", "\"time.trial=haar\"", "\"contact.gap=2e-3\"", "\"version\": "})
    EXPECT_NE(summary.find(part), std::string::npos) << part;
}

TEST(CommandRun, BadInputIsTwoAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string bad = folder.write("bad.toml", with(bar_scene, "gap = 1e-3", "gap = \"big\""));
  const Outcome outcome = run(folder, {"run", bad, "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors, "wavebalance: " + bad + ":13: contact.gap = \"big\": expected a number in m\n");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(CommandRun, MatricesWriteEveryContactAndTheWholeMotion) {
  const TemporaryFolder folder;
  const fs::path scene = fs::path(WAVEBALANCE_SCENES) / "matrices" / "strip_forced.toml";
  const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name :
       {"summary.json", "response.csv", "response.svg", "contacts.csv", "motion.mtx", "scene.toml"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 8);
  EXPECT_EQ(read_csv(folder / "out" / "contacts.csv").rows(), 2u * 1024u);
  EXPECT_NE(read_file(folder / "out" / "motion.mtx").find("\n72 32\n"), std::string::npos);
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"degrees_of_freedom\": 72"), std::string::npos);
  EXPECT_EQ(load_scene(folder / "out" / "scene.toml"), load_scene(scene));
}

TEST(CommandRun, WrongMatricesAreTwoAndWriteNothing) {
  const TemporaryFolder folder;
  write_chain(folder);
  folder.write("m.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1\n2 2 1\n");
  const std::string scene = folder.write("case.toml", chain_scene);
  for (const char* command : {"run", "check"}) {
    std::vector<std::string> arguments{command, scene};
    if (arguments[0] == "run") arguments.insert(arguments.end(), {"--output", folder / "out"});
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors, "wavebalance: " + scene + ":3: structure.mass = \"m.mtx\": the matrix in " +
                                  (folder / "m.mtx").string() +
                                  " is 2 x 2; expected 3 x 3, the size of structure.stiffness in " +
                                  (folder / "k.mtx").string() + "\n");
  }
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(CommandRun, BladeMotionIsASeriesForParaView) {
  const TemporaryFolder folder;
  const fs::path scene = fs::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010" / "blade_mode.toml";
  const Outcome outcome =
      run(folder, {"run", scene, "--output", folder / "out", "--set", "structure.chord_elements=3", "--set",
                   "structure.span_elements=4", "--set", "analysis.energy_ratio=0.5", "--set",
                   "analysis.motion_points=4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string series = read_file(folder / "out" / "motion.pvd");
  for (const char* name : {"motion_0000.vtu", "motion_0003.vtu"}) {
    EXPECT_NE(series.find(name), std::string::npos);
    EXPECT_NE(read_file(folder / "out" / name).find("Name=\"stress\""), std::string::npos);
  }
  EXPECT_EQ(read_csv(folder / "out" / "contacts.csv").rows(), 8u * 1024u);
}

TEST(CommandRun, FailureToConvergeIsThreeWithTheRecord) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", bar_scene), "--output", folder / "out", "--set",
                   "analysis.type=time_stepping", "--set", "analysis.max_periods=1"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.errors.find("not converged"), std::string::npos);
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"converged\": false"), std::string::npos);
}

TEST(CommandRun, OutputUnderAFileIsTwo) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", bar_scene), "--output", folder / "case.toml" / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("case.toml/out"), std::string::npos);
}

TEST(CommandRun, FullDiskIsTwoAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  // A limit of 16 blocks lets the summary pass and stops the response half-way.
  const std::string script = "ulimit -f 16; exec \"$0\" \"$@\"";
  const Outcome outcome =
      Command(folder,
              {"-c", script, WAVEBALANCE_COMMAND, "run", scene, "--no-report", "--output", folder / "out"},
              "sh")
          .wait();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("response.csv: cannot be written: File too large"), std::string::npos)
      << outcome.errors;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(CommandRun, WithoutGnuplotTheNumbersRemain) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  const std::string script = "PATH=/nowhere; exec \"$0\" \"$@\"";
  const Outcome outcome =
      Command(folder,
              {"-c", script, WAVEBALANCE_COMMAND, "run", scene, "--no-report", "--output", folder / "out"},
              "sh")
          .wait();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.errors.find("no picture"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out" / "summary.json"));
  EXPECT_FALSE(fs::exists(folder / "out" / "response.svg"));
}

/// Waits until `done` says so, a minute at most.
bool wait_until(const std::function<bool()>& done) {
  for (int i = 0; i < 1200 && !done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return done();
}

TEST(CommandRun, InterruptLeavesNothing) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  // No two periods agree to 1e-300: without the signal it would go on for hours.
  Command command(folder,
                  {"run", scene, "--output", folder / "out", "--set", "analysis.type=time_stepping", "--set",
                   "analysis.tolerance=1e-300", "--set", "analysis.max_periods=100000000", "--set",
                   "structure.elements=200"},
                  WAVEBALANCE_COMMAND);
  ASSERT_TRUE(wait_until([&] { return command.catches(SIGINT); }));
  command.send(SIGINT);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(outcome.errors.find("interrupted, no results written"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(CommandRun, InterruptedSweepLeavesItsPoints) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  Terminal terminal;
  Command command(folder,
                  {"run", scene, "--output", folder / "out", "--set", "analysis.type=frequency_sweep",
                   "--set", "analysis.frequency_from=100", "--set", "analysis.frequency_to=200", "--set",
                   "analysis.first_step=1e-4", "--set", "analysis.largest_step=1e-4", "--set",
                   "analysis.max_points=1000000"},
                  WAVEBALANCE_COMMAND, &terminal);
  ASSERT_TRUE(
      wait_until([&] { return terminal.text().find("frequency sweep: step ") != std::string::npos; }));
  command.send(SIGINT);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the record holds what was found so far"), std::string::npos)
      << outcome.errors;
  const std::string summary = read_file(folder / "out" / "summary.json");
  EXPECT_NE(summary.find("\"converged\": false"), std::string::npos);
  EXPECT_NE(summary.find("\"status\": \"interrupted\""), std::string::npos);
  EXPECT_GT(read_csv(folder / "out" / "sweep.csv").rows(), 1u);
}

TEST(CommandRun, FolderUsedTwiceHoldsTheSecondRecordAndForeignFiles) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  EXPECT_EQ(run(folder, {"run", scene, "--output", folder / "out"}).exit_code, 0);
  std::ofstream(folder / "out" / "backbone.csv") << "not of this record\n";
  const Outcome outcome =
      run(folder, {"run", scene, "--output", folder / "out", "--set", "analysis.type=frequency_sweep",
                   "--set", "analysis.frequency_from=100", "--set", "analysis.frequency_to=105", "--set",
                   "analysis.stability=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name :
       {"summary.json", "sweep.csv", "sweep.svg", "scene.toml", "backbone.csv", "report.html"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 7);
  EXPECT_EQ(read_file(folder / "out" / "backbone.csv"), "not of this record\n");
}

TEST(CommandRun, NoFileThatItReadsIsReplaced) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", bar_scene);
  const Outcome outcome = run(folder, {"run", scene, "--output", folder.path()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors, "wavebalance: " + scene +
                                ": is read by this command and would be replaced; expected another folder of "
                                "results\n");
  EXPECT_EQ(read_file(scene), bar_scene);
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
  ASSERT_EQ(run(folder, {"run", scene, "--output", folder / "out"}).exit_code, 0);
  const std::string before = read_file(folder / "out" / "response.csv");
  for (const std::string start : {folder / "out", folder / "out" / "response.csv"}) {
    const Outcome again = run(folder, {"run", scene, "--output", folder / "out", "--start-from", start});
    EXPECT_EQ(again.exit_code, 2) << start;
    EXPECT_NE(again.errors.find("is read by this command"), std::string::npos) << again.errors;
  }
  const Outcome own = run(folder, {"run", folder / "out" / "scene.toml", "--output", folder / "out"});
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_EQ(read_file(folder / "out" / "response.csv"), before);
}

TEST(CommandRun, NoFileThatNoRecordListsIsReplaced) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  fs::create_directory(folder / "out");
  for (const char* name : {"response.csv", "scene.toml", "summary.json", "response.svg"}) {
    std::ofstream(folder / "out" / name) << "measured\n";
    const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out"});
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_NE(outcome.errors.find(std::string(name) + ": would be replaced, and no summary.json"),
              std::string::npos)
        << outcome.errors;
    EXPECT_EQ(read_file(folder / "out" / name), "measured\n");
    EXPECT_EQ(TemporaryFolder::count(folder / "out"), 1);
    fs::remove(folder / "out" / name);
  }
  std::ofstream(folder / "out" / "sweep.csv") << "measured\n";  // which this run does not write
  EXPECT_EQ(run(folder, {"run", scene, "--output", folder / "out"}).exit_code, 0);
  EXPECT_EQ(read_file(folder / "out" / "sweep.csv"), "measured\n");
}

TEST(CommandRun, SweepSaysWithWhatItWasSolvedAndWhereItsPeakIs) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", bar_scene), "--output", folder / "out", "--set",
                   "analysis.type=frequency_sweep", "--set", "analysis.frequency_from=100", "--set",
                   "analysis.frequency_to=105", "--set", "analysis.stability=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string summary = read_file(folder / "out" / "summary.json");
  for (const char* part : {"\"trial\": \"fourier\"", "\"weight\": \"fourier\"", "\"functions\": 64",
                           "\"quadrature_points\": 256", "\"formulation\": \"distributional\"",
                           "\"version\": \"", "\"frequency_at_max_displacement_Hz\": 1"})
    EXPECT_NE(summary.find(part), std::string::npos) << part;
}

TEST(CommandRun, UnsetLeavesKeysOfTheFileOut) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  const Outcome outcome =
      run(folder, {"check", scene, "--set", "contact.law=none", "--unset", "contact.constant", "--unset",
                   "contact.exponent", "--unset", "contact.gap"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const Outcome wrong = run(folder, {"check", scene, "--unset", "contact.constnt"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.errors, "wavebalance: --unset contact.constnt: there is no such key in " + scene +
                              "; did you mean contact.constant?\n");
}

TEST(CommandRun, MoreMemoryThanAllowedIsTwoBeforeAnythingIsTaken) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  for (const char* large : {"analysis.output_points=16777216", "time.quadrature_points=16777216"}) {
    const Outcome outcome =
        run(folder, {"run", scene, "--output", folder / "out", "--set", large, "--max-memory", "0.5"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find("this scene would take about "), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find(" GB of memory and --max-memory allows 500 MB"), std::string::npos)
        << outcome.errors;
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  EXPECT_EQ(run(folder, {"run", scene, "-q", "--output", folder / "out", "--max-memory", "0.5"}).exit_code,
            0);
}

TEST(CommandRun, OutputWithoutANameIsTwo) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"run", folder.write("case.toml", bar_scene), "--output", ""});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors,
            "wavebalance: --output is \"\"; expected the name of a folder, which is made if it is missing\n");
}

TEST(CommandRun, NonlinearModeWritesItsBackbone) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("rod.toml", rod_scene);
  const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name : {"summary.json", "backbone.csv", "backbone.svg", "scene.toml", "report.html"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 6);
  const Table table = read_csv(folder / "out" / "backbone.csv");
  EXPECT_TRUE(table.has_column("rayleigh_frequency_ratio"));
  EXPECT_GT(table.rows(), 50u);
  EXPECT_EQ(load_scene(folder / "out" / "scene.toml"), load_scene(scene));
}

TEST(CommandRun, MotionOfAPrescribedEnergyWritesAResponse) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"run", folder.write("rod.toml", rod_scene), "--output", folder / "out",
                                       "--set", "analysis.energy_ratio=0.7"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder / "out" / "response.csv"));
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"status\": \"linear\""), std::string::npos);
}

TEST(CommandRun, ModeWithoutAMotionOfThatEnergyIsThree) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"run", folder.write("rod.toml", rod_scene), "--output", folder / "out",
                                       "--set", "analysis.energy_ratio=1e9"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(read_file(folder / "out" / "summary.json").find("\"converged\": false"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "out" / "response.csv"));
}

}  // namespace
