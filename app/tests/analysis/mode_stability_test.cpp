#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;

Scene stopped_rod(const std::vector<std::string>& overrides = {}) {
  const std::string text = with(rod_scene, "\"rigid\"", "\"linear\"\nstiffness = 5e8");
  return parse_scene(text, "rod.toml", overrides);
}

bool has(const Record& record, const std::string& key) {
  return std::any_of(record.summary.begin(), record.summary.end(),
                     [&](const auto& entry) { return entry.name == key; });
}

std::vector<std::string> labels_of(const Record& record) {
  std::vector<std::string> labels;
  for (const Series& series : record.figure.panels.front().series) labels.push_back(series.label);
  return labels;
}

bool contains(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

TEST(ModeStabilityScene, BackboneHasACountAtEveryPointThatIsKnownAndItsSpecialPoints) {
  const Record record = analyse(stopped_rod());
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "converged");
  const auto unstable = record.backbone.numbers("unstable"), contacts = record.backbone.numbers("contacts");
  EXPECT_EQ(unstable[0], 0.0);
  EXPECT_EQ(contacts[5], 0.0);
  EXPECT_EQ(contacts.back(), 1.0);
  const auto special = value_of<Table>(record.summary, "special_points");
  double changes = 0.0;
  for (std::size_t i = 1; i < unstable.size(); ++i)
    if (unstable[i] != unstable[i - 1]) ++changes;
  EXPECT_GE(double(special.rows()), changes);
  EXPECT_GT(changes, 0.0);
  const auto labels = labels_of(record);
  EXPECT_TRUE(contains(labels, "ω"));
  EXPECT_TRUE(contains(labels, "ω, unstable"));
}

TEST(ModeStabilityScene, MotionOfAnEnergyHasItsLeadingMultiplier) {
  const Record record = analyse(stopped_rod({"analysis.energy_ratio=1.5"}));
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "unstable_multipliers"), 0);
  const double error = value_of<double>(record.summary, "leading_multiplier_error");
  EXPECT_LT(error, 1e-2);
  EXPECT_NEAR(std::hypot(value_of<double>(record.summary, "leading_multiplier_real"),
                         value_of<double>(record.summary, "leading_multiplier_imag")),
              1.0, 2.0 * error);
}

TEST(ModeStabilityScene, RigidContactWithMassHasNoStabilityWithoutALawOfImpact) {
  const Record curve = analyse(parse_scene(rod_scene, "rod.toml", {}));
  EXPECT_EQ(value_of<std::string>(curve.summary, "stability"), "no_law_of_impact");
  EXPECT_FALSE(has(curve, "special_points"));
  EXPECT_FALSE(contains(labels_of(curve), "ω, unstable"));
  const Record motion =
      analyse(parse_scene(rod_scene, "rod.toml", std::vector<std::string>{"analysis.energy_ratio=2"}));
  EXPECT_EQ(value_of<std::string>(motion.summary, "stability"), "no_law_of_impact");
  EXPECT_TRUE(std::isnan(value_of<double>(motion.summary, "unstable_multipliers")));
}

TEST(ModeStabilityScene, RigidContactWithoutMassHasAStability) {
  const std::vector<std::string> massless{"contact.mass=redistribute", "analysis.harmonics=20",
                                          "analysis.samples=160", "analysis.points=100",
                                          "analysis.largest_energy=2"};
  const Record record = analyse(parse_scene(rod_scene, "rod.toml", massless));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "converged");
  EXPECT_LT(value_of<double>(record.summary, "contact_mass_frequency_change"), 0.2);
  const auto unstable = record.backbone.numbers("unstable"),
             ratio = record.backbone.numbers("frequency_ratio");
  EXPECT_EQ(unstable[0], 0.0);
  EXPECT_GT(ratio.back(), 1.05);
}

TEST(ModeStabilityScene, IsLeftOutOnRequest) {
  const Record record = analyse(stopped_rod({"analysis.stability=false"}));
  EXPECT_FALSE(has(record, "stability"));
  EXPECT_TRUE(labels_of(record).front().find("ω") == 0);
}

}  // namespace
