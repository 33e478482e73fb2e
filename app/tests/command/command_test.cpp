#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "support/chain_files.hpp"
#include "support/scene_texts.hpp"
#include "support/temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/table.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string output;
  std::string errors;
};

/// The command with its streams in files of `folder`.
class Command {
 public:
  Command(const TemporaryFolder& folder, std::vector<std::string> arguments, const std::string& program)
      : output_(folder / "stdout"), errors_(folder / "stderr") {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> pointers;
    for (auto& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 1, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::posix_spawn_file_actions_addopen(&actions, 2, errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    EXPECT_EQ(::posix_spawnp(&child_, pointers[0], &actions, nullptr, pointers.data(), environ), 0);
    ::posix_spawn_file_actions_destroy(&actions);
  }

  void send(int signal) const { ::kill(child_, signal); }

  /// Whether the program has a handler for the signal, as /proc says.
  bool catches(int signal) const {
    const std::string status = read_file("/proc/" + std::to_string(child_) + "/status");
    const auto place = status.find("SigCgt:");
    return place != std::string::npos &&
           (std::stoull(status.substr(place + 7), nullptr, 16) >> (signal - 1) & 1) == 1;
  }

  Outcome wait() {
    int status = 0;
    ::waitpid(child_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_file(output_),
            read_file(errors_)};
  }

 private:
  fs::path output_, errors_;
  pid_t child_ = 0;
};

Outcome run(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  return Command(folder, std::move(arguments), WAVEBALANCE_COMMAND).wait();
}

TEST(CommandRun, SolvesAndWritesEverything) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  for (const char* name : {"summary.json", "response.csv", "response.svg", "scene.toml"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 4);
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
  EXPECT_EQ(outcome.errors.find("wavebalance: warning: the condition estimate "), 0u) << outcome.errors;
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

TEST(CommandRun, ToleranceOutOfReachIsThree) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"run", folder.write("case.toml", tolerance_scene("1e-15")), "--output",
                                       folder / "out", "--set", "contact.gap=-5e-3"});
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
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 6);
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
    EXPECT_EQ(outcome.errors,
              "wavebalance: " + scene +
                  ":3: structure.mass = \"m.mtx\": the matrix is 2 x 2; expected 3 x 3, the size "
                  "of structure.stiffness\n");
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
      Command(folder, {"-c", script, WAVEBALANCE_COMMAND, "run", scene, "--output", folder / "out"}, "sh")
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
      Command(folder, {"-c", script, WAVEBALANCE_COMMAND, "run", scene, "--output", folder / "out"}, "sh")
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
  Command command(folder,
                  {"run", scene, "--output", folder / "out", "--set", "analysis.type=frequency_sweep", "--set",
                   "analysis.frequency_from=100", "--set", "analysis.frequency_to=200", "--set",
                   "analysis.first_step=1e-4", "--set", "analysis.largest_step=1e-4", "--set",
                   "analysis.max_points=1000000"},
                  WAVEBALANCE_COMMAND);
  ASSERT_TRUE(wait_until([&] { return read_file(folder / "stderr").find("frequency sweep: step ") != std::string::npos; }));
  command.send(SIGINT);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the record holds the points so far"), std::string::npos) << outcome.errors;
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
      run(folder, {"run", scene, "--output", folder / "out", "--set", "analysis.type=frequency_sweep", "--set",
                   "analysis.frequency_from=100", "--set", "analysis.frequency_to=105"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name : {"summary.json", "sweep.csv", "sweep.svg", "scene.toml", "backbone.csv"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 5);
  EXPECT_EQ(read_file(folder / "out" / "backbone.csv"), "not of this record\n");
}

TEST(CommandRun, SweepSaysWithWhatItWasSolvedAndWhereItsPeakIs) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"run", folder.write("case.toml", bar_scene), "--output", folder / "out", "--set",
                   "analysis.type=frequency_sweep", "--set", "analysis.frequency_from=100", "--set",
                   "analysis.frequency_to=105"});
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
    const Outcome outcome = run(
        folder, {"run", scene, "--output", folder / "out", "--set", large, "--max-memory", "0.5"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find("this scene would take about "), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find(" GB of memory and --max-memory allows 500 MB"), std::string::npos)
        << outcome.errors;
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  EXPECT_EQ(run(folder, {"run", scene, "-q", "--output", folder / "out", "--max-memory", "0.5"}).exit_code, 0);
}

TEST(CommandCheck, SaysWhatASceneIsExpectedToTake) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  EXPECT_NE(run(folder, {"check", scene}).output.find("cost       about 0.0"), std::string::npos);
  const Outcome large = run(folder, {"check", scene, "--set", "time.functions=1048576", "--set",
                                     "time.quadrature_points=16777216", "--set",
                                     "analysis.output_points=16777216"});
  EXPECT_EQ(large.exit_code, 0) << large.errors;
  EXPECT_NE(large.output.find(" GB of memory"), std::string::npos) << large.output;
}

TEST(CommandRun, OutputWithoutANameIsTwo) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"run", folder.write("case.toml", bar_scene), "--output", ""});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors,
            "wavebalance: --output is \"\"; expected the name of a folder, which is made if it is missing\n");
}

TEST(CommandCheck, SaysWhatWouldBeSolvedAndWritesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run(folder, {"check", folder.write("case.toml", bar_scene), "--set", "time.functions=32"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("32 unknowns"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("admissible"), std::string::npos);
  EXPECT_EQ(TemporaryFolder::count(folder.path()), 3);  // the scene and the two streams
}

TEST(CommandRun, NonlinearModeWritesItsBackbone) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("rod.toml", rod_scene);
  const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* name : {"summary.json", "backbone.csv", "backbone.svg", "scene.toml"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 4);
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

TEST(CommandCheck, SaysWhatAModeWouldBe) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"check", folder.write("rod.toml", rod_scene)});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* part : {"rigid obstacle", "10 harmonics", "200 points", "20 contact forces", "1297 Hz"})
    EXPECT_NE(outcome.output.find(part), std::string::npos) << part << " is not in\n" << outcome.output;
  EXPECT_EQ(outcome.output.find("forcing"), std::string::npos);
}

TEST(CommandCheck, SaysThatSizesAreChosen) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"check", folder.write("case.toml", tolerance_scene("1e-3"))});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("chosen for a relative error of 0.001"), std::string::npos) << outcome.output;
}

TEST(CommandCheck, InadmissiblePairIsTwo) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"check", folder.write("case.toml", bar_scene), "--set",
                                       "time.trial=haar", "--set", "time.weight=haar"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("--set time.trial=haar"), std::string::npos) << outcome.errors;
}

TEST(CommandKeys, ListsEveryKey) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"keys"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, describe_scene_keys());
}

TEST(CommandKeys, FullStandardOutputIsTwo) {
  const TemporaryFolder folder;
  const Outcome outcome =
      Command(folder, {"-c", "\"$0\" keys > /dev/full", WAVEBALANCE_COMMAND}, "sh").wait();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors, "wavebalance: standard output: cannot be written: No space left on device\n");
}

TEST(CommandHelp, HoldsASceneThatLoads) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto begin = outcome.output.find("[structure]");
  const auto end = outcome.output.find("\nCommands to start with");
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(parse_scene(outcome.output.substr(begin, end - begin), "help"),
            parse_scene(bar_scene, "case.toml"));
  for (const char* text : {"Exit codes", "wavebalance run", "wavebalance check", "keys"})
    EXPECT_NE(outcome.output.find(text), std::string::npos) << text;
}

TEST(CommandLine, WrongUsageIsTwo) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"solve", scene},
                                             {"run"},
                                             {"run", scene},
                                             {"run", scene, "--output"},
                                             {"check"},
                                             {"check", scene, "--sett", "a.b=1"},
                                             {"check", scene, "--set"},
                                             {"check", scene, "--set", "gap"},
                                             {"check", folder / "missing.toml"}})
    EXPECT_EQ(run(folder, arguments).exit_code, 2);
}

TEST(CommandLine, UnknownCommandIsNamedBesideThoseThereAre) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {"nonsense"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors, "wavebalance: unknown command nonsense; there are run, check, keys\n");
}

TEST(CommandLine, VersionIsTheProjects) {
  const TemporaryFolder folder;
  EXPECT_EQ(run(folder, {"--version"}).output, "wavebalance " + std::string(version()) + "\n");
}

TEST(Scenes, AllOfTheRepositoryLoad) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(WAVEBALANCE_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
  }
  EXPECT_GE(count, 3);
}

}  // namespace
