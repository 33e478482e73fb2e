#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;
using wavebalance::solvers::ModeStatus;

constexpr double stop_stiffness = 1e9;  // N/m, five times that of the rod

Scene elastic_rod(const std::vector<std::string>& overrides = {}) {
  const std::string text = with(rod_scene, "\"rigid\"", "\"linear\"\nstiffness = 1e9");
  return parse_scene(text, "rod.toml", overrides);
}

TEST(ElasticModeScene, BackboneReachesTheEnergyAskedFor) {
  const Record record = analyse(elastic_rod({"analysis.stability=false"}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(record.status, "converged");
  EXPECT_LT(value_of<double>(record.summary, "residual"), 1e-8);
  EXPECT_GE(value_of<double>(record.summary, "largest_energy_ratio"), 10.0);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "functions"), 21);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "quadrature_points"), 80);
  const auto ratio = record.backbone.numbers("frequency_ratio");
  const auto energy = record.backbone.numbers("energy_ratio");
  const auto modal = record.backbone.numbers("modal_energy_ratio");
  EXPECT_EQ(energy[5], 1.0);
  EXPECT_GT(ratio.back(), 1.1);
  EXPECT_LT(modal.back(), energy.back());
  EXPECT_FALSE(record.figure.panels.empty());
}

TEST(ElasticModeScene, MotionOfAnEnergyHasTheForceOfItsLaw) {
  const Record record = analyse(elastic_rod({"analysis.energy_ratio=3"}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "energy_ratio"), 3.0, 1e-8);
  const double highest = value_of<double>(record.summary, "max_displacement_m");
  EXPECT_GT(highest, 1e-3);
  EXPECT_NEAR(value_of<double>(record.summary, "max_contact_force_N"), stop_stiffness * (highest - 1e-3),
              1e-9 * stop_stiffness * highest);
  EXPECT_EQ(record.response.rows(), 1024u);
}

TEST(ElasticModeScene, EnergyBelowContactIsTheLinearMode) {
  const Record record = analyse(elastic_rod({"analysis.energy_ratio=0.25"}));
  EXPECT_EQ(record.status, "linear");
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 0.5e-3, 1e-12);
}

TEST(ElasticModeScene, ExponentialLawHasABackbone) {
  const std::string text = with(rod_scene, "\"rigid\"", "\"exponential\"\nconstant = 1e5\nexponent = 5e3");
  const Record record = analyse(parse_scene(text, "rod.toml", {{"analysis.stability=false"}}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_GE(value_of<double>(record.summary, "largest_energy_ratio"), 10.0);
}

TEST(ElasticModeScene, PairsOfBasesAgree) {
  const auto frequency = [](const std::string& trial, const std::string& weight,
                            const std::string& functions) {
    const Record record = analyse(
        elastic_rod({"analysis.energy_ratio=3", "time.trial=" + trial, "time.weight=" + weight,
                     "time.functions=" + functions, "time.quadrature_points=512", "structure.elements=2"}));
    EXPECT_TRUE(record.converged) << trial << weight << ' ' << record.status;
    return value_of<double>(record.summary, "frequency_ratio");
  };
  const double reference = frequency("fourier", "fourier", "127");
  for (const auto& [trial, weight] :
       std::vector<std::pair<std::string, std::string>>{{"fourier", "fourier"},
                                                        {"bspline", "bspline"},
                                                        {"daubechies6", "daubechies6"},
                                                        {"daubechies6", "fourier"}})
    EXPECT_NEAR(frequency(trial, weight, "64"), reference, 2e-4) << trial << weight;
  EXPECT_NEAR(frequency("haar", "fourier", "64"), reference, 2e-4);
}

TEST(ElasticModeScene, CurveBelowTheEnergyAskedForSaysWhereItEnds) {
  const Record record =
      analyse(elastic_rod({"analysis.last_frequency_ratio=1.02", "analysis.stability=false"}));
  EXPECT_TRUE(record.converged);
  EXPECT_NE(record.status.find("ended at frequency ratio 1.02"), std::string::npos) << record.status;
  EXPECT_NE(record.status.find("before the energy ratio 10 asked for: last_frequency_ratio is reached"),
            std::string::npos)
      << record.status;
  const Record motion = analyse(elastic_rod(
      {"analysis.last_frequency_ratio=1.02", "analysis.energy_ratio=9", "analysis.stability=false"}));
  EXPECT_FALSE(motion.converged);
  EXPECT_TRUE(motion.status.starts_with("ended at frequency ratio 1.02")) << motion.status;
}

std::string message_of(const std::vector<std::string>& overrides) {
  try {
    elastic_rod(overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ElasticModeScene, BadInputNamesTheKeyAndWhatIsAllowed) {
  EXPECT_NE(message_of({"analysis.samples=20"}).find("expected samples > 2 x harmonics = 20"),
            std::string::npos);
  EXPECT_NE(message_of({"time.trial=fourier"}).find("expected both time.trial and time.weight"),
            std::string::npos);
  EXPECT_NE(
      message_of({"time.trial=haar", "time.weight=bspline", "time.functions=64"}).find("damps a free motion"),
      std::string::npos);
}

}  // namespace
