// Responses and modes of one structure over each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "support/stop_scene.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

Outcome run_stop(const TemporaryFolder& folder, const std::string& name, std::vector<std::string> sets) {
  std::vector<std::string> arguments{
      "run", folder.write("stop.toml", stop_scene), "--output", folder / name, "--quiet", "--no-report"};
  for (const std::string& one : sets) arguments.insert(arguments.end(), {"--set", one});
  return run(folder, std::move(arguments));
}

/// A copy of a record that was written once.
void copy_stop(const TemporaryFolder& folder, const std::string& name,
               const std::vector<std::string>& sets = {}) {
  static const TemporaryFolder records;
  static std::map<std::vector<std::string>, std::string> names;
  const auto [known, is_new] = names.emplace(sets, std::to_string(names.size()));
  if (is_new) {
    ASSERT_EQ(run_stop(records, known->second, sets).exit_code, 0);
  }
  fs::copy(records / known->second, folder / name, fs::copy_options::recursive);
}

const std::vector<std::string> undamped_mode{"analysis.type=nonlinear_mode", "structure.stiffness_damping=0",
                                             "analysis.last_frequency_ratio=1.4", "analysis.points=60",
                                             "analysis.largest_energy=20"};

Outcome run_mode(const TemporaryFolder& folder, const std::string& name) {
  const std::string scene =
      with(with(with(stop_scene, "frequency_from = 0.13\n", ""), "frequency_to = 0.25\n", ""),
           "type = \"frequency_sweep\"\n", "");
  std::vector<std::string> arguments{
      "run", folder.write("mode.toml", scene), "--output", folder / name, "--quiet", "--no-report"};
  for (const std::string& one : undamped_mode) arguments.insert(arguments.end(), {"--set", one});
  return run(folder, std::move(arguments));
}

/// Frequency of a curve where its displacement first reaches a value.
double frequency_at(const Table& curve, double displacement) {
  const auto f = curve.numbers("frequency_Hz"), u = curve.numbers("displacement_m");
  for (std::size_t i = 1; i < u.size(); ++i)
    if (u[i - 1] < displacement && u[i] >= displacement)
      return f[i - 1] + (f[i] - f[i - 1]) * (displacement - u[i - 1]) / (u[i] - u[i - 1]);
  return std::nan("");
}

TEST(CommandOverlay, ReplacesNoFileThatNoRecordLists) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(copy_stop(folder, "low", {"forcing.amplitude=0.1"}));
  fs::create_directory(folder / "picture");
  folder.write("picture/overlay.csv", "measured\n");
  const Outcome outcome = run(folder, {"overlay", folder / "low", "--output", folder / "picture"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("overlay.csv: would be replaced"), std::string::npos) << outcome.errors;
  EXPECT_EQ(read_file(folder / "picture" / "overlay.csv"), "measured\n");
}

// Resonance of a lightly damped structure lies on the backbone of its mode.
TEST(CommandOverlay, LaysPeaksOfResponsesOnTheBackbone) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(copy_stop(folder, "low", {"forcing.amplitude=0.1"}));
  ASSERT_NO_FATAL_FAILURE(copy_stop(folder, "high"));
  const Outcome mode = run_mode(folder, "mode");
  ASSERT_EQ(mode.exit_code, 0) << mode.errors;
  const Outcome outcome = run(
      folder, {"overlay", folder / "mode", folder / "low", folder / "high", "--output", folder / "picture"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  for (const char* name :
       {"overlay.svg", "overlay.png", "overlay.html", "overlay.figure.js", "overlay.csv", "summary.json"})
    EXPECT_TRUE(fs::exists(folder / "picture" / name)) << name;
  EXPECT_EQ(TemporaryFolder::count(folder / "picture"), 6);
  const Table all = read_csv(folder / "picture" / "overlay.csv");
  const Table backbone = all.where("kind", "nonlinear_mode");
  for (const char* name : {"low", "high"}) {
    const Table curve = all.where("curve", name);
    const auto u = curve.numbers("displacement_m"), f = curve.numbers("frequency_Hz");
    ASSERT_FALSE(u.empty()) << name;
    const auto peak = std::size_t(std::max_element(u.begin(), u.end()) - u.begin());
    EXPECT_GT(u[peak], 1.0);
    EXPECT_NEAR(frequency_at(backbone, u[peak]), f[peak], 0.01 * f[peak]) << name;
  }
  const std::string page = read_file(folder / "picture" / "overlay.html");
  EXPECT_NE(page.find("overlay.svg"), std::string::npos);
}

TEST(CommandOverlay, TakesResponsesAsPointsAndEveryQuantity) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(copy_stop(folder, "sweep"));
  const std::string one = with(with(stop_scene, "frequency_from = 0.13\n", ""), "frequency_to = 0.25\n", "");
  ASSERT_EQ(run(folder, {"run", folder.write("one.toml", one), "--set", "analysis.type=forced_response", "-o",
                         folder / "point", "-q"})
                .exit_code,
            0);
  for (const char* quantity : {"max", "min", "max_abs", "rms"}) {
    const Outcome outcome = run(folder, {"overlay", folder / "sweep", folder / "point", "-o",
                                         folder / "picture", "--quantity", quantity, "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    const Table point = read_csv(folder / "picture" / "overlay.csv").where("kind", "response");
    ASSERT_EQ(point.rows(), 1u);
    EXPECT_EQ(point.numbers("frequency_Hz"), std::vector<double>{0.18});
    EXPECT_TRUE(std::isfinite(point.numbers("displacement_m")[0])) << quantity;
  }
}

TEST(CommandOverlay, RefusesAnotherStructureAndSaysWhereItDiffers) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(copy_stop(folder, "one"));
  ASSERT_EQ(run_stop(folder, "two", {"structure.density=2.1"}).exit_code, 0);
  ASSERT_EQ(run_stop(folder, "gap", {"contact.gap=0.9"}).exit_code, 0);
  const Outcome outcome = run(folder, {"overlay", folder / "one", folder / "two", "-o", folder / "picture"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find(
                "two is of another structure than the first folder: structure.density is 2.1 and not 2.0"),
            std::string::npos)
      << outcome.errors;
  EXPECT_FALSE(fs::exists(folder / "picture"));
  const Outcome warned = run(folder, {"overlay", folder / "one", folder / "gap", "-o", folder / "picture"});
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_NE(warned.errors.find("has another gap"), std::string::npos) << warned.errors;
}

TEST(CommandOverlay, RefusesFoldersWithoutResultsAndItsOwnInputAsOutput) {
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(copy_stop(folder, "one"));
  fs::create_directory(folder / "empty");
  const Outcome empty = run(folder, {"overlay", folder / "empty", "-o", folder / "picture"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_NE(empty.errors.find("holds no scene.toml"), std::string::npos) << empty.errors;
  const Outcome same = run(folder, {"overlay", folder / "one", "-o", folder / "one"});
  EXPECT_EQ(same.exit_code, 2);
  EXPECT_NE(same.errors.find("expected another folder"), std::string::npos) << same.errors;
  EXPECT_TRUE(fs::exists(folder / "one" / "sweep.csv"));
  const Outcome quantity =
      run(folder, {"overlay", folder / "one", "-o", folder / "picture", "--quantity", "peak"});
  EXPECT_EQ(quantity.exit_code, 2);
  EXPECT_NE(quantity.errors.find("expected max, min, max_abs or rms"), std::string::npos) << quantity.errors;
}

// One command writes a motion, the next starts from it.
TEST(CommandRun, StartsFromAMotionOfAnEarlierSweep) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_stop(folder, "curve", {"analysis.motion_at=[\"peak\", 0.18, 0.185]"}).exit_code, 0);
  const std::string one = with(with(stop_scene, "frequency_from = 0.13\n", ""), "frequency_to = 0.25\n", "");
  const std::vector<std::string> response{
      "run", folder.write("one.toml", one), "--set", "analysis.type=forced_response", "-o", folder / "upper"};
  std::vector<std::string> several = response, upper = response, missing = response;
  several.insert(several.end(), {"--start-from", folder / "curve"});
  const Outcome refused = run(folder, several);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("name the one to start from"), std::string::npos) << refused.errors;
  missing.insert(missing.end(), {"--start-from", folder / "nowhere"});
  EXPECT_EQ(run(folder, missing).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "upper"));
  upper.insert(upper.end(), {"--start-from", folder / "curve" / "motion_0.185Hz_1.csv"});
  const Outcome outcome = run(folder, upper);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("start_distance"), std::string::npos);
  const auto found = read_csv(folder / "upper" / "response.csv").numbers("displacement_m"),
             expected = read_csv(folder / "curve" / "motion_0.18Hz_1.csv").numbers("displacement_m");
  for (std::size_t l = 0; l < found.size(); ++l) ASSERT_NEAR(found[l], expected[l], 1e-7);
  EXPECT_NE(read_file(folder / "upper" / "report.html").find("--start-from"), std::string::npos);
}

}  // namespace
