#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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

TEST(CommandCheck, SaysWhatASceneIsExpectedToTake) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  EXPECT_NE(run(folder, {"check", scene}).output.find("cost       about 0.0"), std::string::npos);
  const Outcome large =
      run(folder, {"check", scene, "--set", "time.functions=1048576", "--set",
                   "time.quadrature_points=16777216", "--set", "analysis.output_points=16777216"});
  EXPECT_EQ(large.exit_code, 0) << large.errors;
  EXPECT_NE(large.output.find(" GB of memory"), std::string::npos) << large.output;
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
  Scene expected = parse_scene(bar_scene, "case.toml");
  expected.time.functions = 63;  // an odd number has no Nyquist function
  EXPECT_EQ(parse_scene(outcome.output.substr(begin, end - begin), "help"), expected);
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
  EXPECT_EQ(
      outcome.errors,
      "wavebalance: unknown command nonsense; there are run, check, compare, overlay, study, keys, init\n");
  EXPECT_NE(run(folder, {"chek"}).errors.find("did you mean check?"), std::string::npos);
  EXPECT_NE(run(folder, {"case.toml"}).errors.find("did you mean run case.toml?"), std::string::npos);
}

TEST(CommandLine, WrongArgumentsAreNamedWithWhatIsProbablyMeantAndWhereToRead) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  EXPECT_NE(run(folder, {}).errors.find("no command; there are run, "), std::string::npos);
  EXPECT_NE(run(folder, {"help"}).errors.find("did you mean --help?"), std::string::npos);
  EXPECT_EQ(run(folder, {"run", scene}).errors,
            "wavebalance: --output is required; `wavebalance run --help` says what it takes\n");
  EXPECT_EQ(
      run(folder, {"run", scene, "--outpt", "x"}).errors,
      "wavebalance: there is no option --outpt (did you mean --output?); `wavebalance run --help` says what it "
      "takes\n");
  EXPECT_NE(run(folder, {"run", scene, "--outptu", "x"}).errors.find("did you mean --output?"),
            std::string::npos);
}

TEST(CommandLine, ThreadsThatAreNoneAreNamedWithWhatIsAllowedAndNothingIsWritten) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  for (const char* threads : {"-1", "1.5", "two", "", "1025"}) {
    const Outcome outcome = run(folder, {"run", scene, "--output", folder / "out", "--threads", threads});
    EXPECT_EQ(outcome.exit_code, 2) << threads;
    EXPECT_NE(outcome.errors.find("--threads: \"" + std::string(threads) +
                                  "\": expected a whole number from 0 to 1024; 0: one per core"),
              std::string::npos)
        << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

TEST(CommandLine, RunsOnSeveralThreadsHaveTheDigitsOfOne) {
  const TemporaryFolder folder;
  const auto response = [&](const char* threads) {
    const Outcome outcome = run(folder, {"run", WAVEBALANCE_SCENES "/matrices/strip_forced.toml", "--output",
                                         folder / threads, "--threads", threads, "--no-report"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return read_file(folder / threads / "response.csv");
  };
  const std::string one = response("1");
  EXPECT_FALSE(one.empty());
  for (const char* threads : {"0", "2", "3"}) EXPECT_EQ(response(threads), one) << threads;
}

TEST(CommandLine, MissingSceneIsAnsweredWithTheCommandThatWritesOne) {
  const TemporaryFolder folder;
  for (const char* command : {"run", "check", "compare"}) {
    std::vector<std::string> arguments{command, folder / "missing.toml"};
    if (arguments[0] != "check") arguments.insert(arguments.end(), {"--output", folder / "results"});
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors,
              "wavebalance: " + (folder / "missing.toml").string() +
                  ": there is no such file; `wavebalance init` writes a scene to start from\n");
  }
}

TEST(CommandLine, VersionIsTheProjects) {
  const TemporaryFolder folder;
  EXPECT_EQ(run(folder, {"--version"}).output, "wavebalance " + std::string(version()) + "\n");
}

TEST(Scenes, AllOfTheRepositoryLoad) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(WAVEBALANCE_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    const fs::path folder = entry.path().parent_path();
    const auto holds = [&](const char* ending) {
      return fs::exists(folder / (folder.filename().string() + ending));
    };
    if (holds(".inp") && !holds(".sti")) continue;  // CalculiX makes its matrices, PipePage tests it
    ++count;
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
  }
  EXPECT_GE(count, 3);
}

}  // namespace
