// Sweeps with analysis.exact: curves of the structure's own motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "support/scene_error.hpp"
#include "support/stop_scene.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

Record record_of(std::vector<std::string> overrides, const Observer& observer = {}) {
  overrides.emplace_back("analysis.exact=true");
  return analyse(parse_scene(stop_scene, "stop.toml", overrides), observer);
}

TEST(ExactSweep, HasTheFoldsOfTheOscillatorWhateverTheFunctionsOfItsStart) {
  const Record coarse = record_of({"time.functions=15", "time.quadrature_points=64"}),
               fine = record_of({"time.functions=255", "time.quadrature_points=1024"});
  for (const Record* record : {&coarse, &fine}) {
    EXPECT_TRUE(record->converged) << record->status;
    EXPECT_EQ(value_of<std::string>(record->summary, "solved_by"), "phases");
    EXPECT_EQ(value_of<std::string>(record->summary, "stability"), "converged");
  }
  const auto turns = value_of<std::vector<double>>(coarse.summary, "turning_points_Hz"),
             others = value_of<std::vector<double>>(fine.summary, "turning_points_Hz");
  ASSERT_EQ(turns.size(), 2u);
  ASSERT_EQ(others.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(turns[i], others[i], 1e-10);
  const Table points = value_of<Table>(coarse.summary, "special_points");
  EXPECT_EQ(points.where("type", "grazing").rows(), 2u);
  for (std::size_t i = 0; i < points.rows(); ++i) {
    EXPECT_EQ(points.texts("status")[i], "located");
    if (points.texts("type")[i] == "grazing") continue;
    const std::complex<double> multiplier(points.numbers("multiplier_real")[i],
                                          points.numbers("multiplier_imag")[i]);
    EXPECT_NEAR(std::abs(multiplier), 1.0, 1e-8);
  }
}

TEST(ExactSweep, TellsOfEachPointItsMeasuresItsStabilityAndWhatItIsBy) {
  const Record record = record_of({});
  const Table& sweep = record.sweep;
  ASSERT_GT(sweep.rows(), 20u);
  EXPECT_EQ(sweep.columns().front(), "frequency_Hz");
  for (std::size_t i = 0; i < sweep.rows(); ++i) {
    EXPECT_EQ(sweep.texts("stability_by")[i], "phases");
    EXPECT_EQ(sweep.texts("phases_status")[i], "converged");
    EXPECT_LT(sweep.numbers("error_of_displacement")[i], 1e-8);
    EXPECT_EQ(sweep.numbers("contacts")[i] > 0.0, sweep.numbers("max_contact_force_N")[i] > 0.0);
    EXPECT_LE(sweep.numbers("max_displacement_m")[i], sweep.numbers("max_abs_displacement_m")[i]);
  }
  const auto unstable = sweep.numbers("unstable");
  EXPECT_EQ(*std::max_element(unstable.begin(), unstable.end()), 1.0);
  EXPECT_EQ(unstable.front(), 0.0);
  EXPECT_EQ(unstable.back(), 0.0);
}

TEST(ExactSweep, IsFollowedOverTheAmplitudeToo) {
  const std::string text(stop_scene);
  const std::string scene =
      text.substr(0, text.find("type = \"frequency_sweep\"")) +
      "type = \"amplitude_sweep\"\namplitude_from = 0.05\namplitude_to = 0.5\nexact = true\n";
  const Record record = analyse(parse_scene(scene, "load.toml", {}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::vector<double>>(record.summary, "turning_points_N").size(), 2u);
  EXPECT_EQ(record.sweep.columns().front(), "amplitude_N");
  EXPECT_NEAR(record.sweep.numbers("amplitude_N").back(), 0.5, 1e-12);
}

TEST(ExactSweep, ThatIsInterruptedHasItsPointsSoFar) {
  const Record record = record_of({}, [](const solvers::Progress& progress) {
    return progress.phase != "exact curve" || progress.step < 9;
  });
  EXPECT_FALSE(record.converged);
  EXPECT_TRUE(record.interrupted);
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_GT(record.sweep.rows(), 5u);
}

TEST(ExactSweep, ThatIsInterruptedAtOnceSaysSoWhateverItHas) {
  const Record record =
      record_of({"analysis.frequency_from=0.18"}, [](const solvers::Progress&) { return false; });
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_LE(record.sweep.rows(), 1u);
}

TEST(ExactSweep, RefusesByNameWhatItDoesNotDo) {
  const auto error = [](std::vector<std::string> overrides) {
    overrides.emplace_back("analysis.exact=true");
    std::string message;
    error_of(stop_scene, overrides, &message);
    return message;
  };
  for (const char* key : {"analysis.branches=true", "analysis.motion_at=[\"peak\"]", "analysis.phases=true",
                          "analysis.subharmonic=2"}) {
    const std::string text(key);
    EXPECT_NE(error({key}).find("not with " + text.substr(0, text.find('='))), std::string::npos)
        << error({key});
  }
}

}  // namespace
}  // namespace wavebalance::app
