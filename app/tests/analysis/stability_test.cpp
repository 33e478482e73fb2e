// Stability as records, tables and pictures hold it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/summary_value.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::app {
namespace {

Scene fourier_scene(const std::string& name, const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"time.trial=fourier", "time.weight=fourier", "time.functions=63",
                               "time.quadrature_points=512"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/" + name + ".toml", all);
}

bool holds(const Summary& summary, const std::string& name) {
  return std::any_of(summary.begin(), summary.end(), [&](const auto& entry) { return entry.name == name; });
}

// Between grazing and the period doubling at 2840.48 Hz.
TEST(RecordOfAResponse, SaysThatAPeriodDoubledMotionIsUnstable) {
  const Record record = analyse(fourier_scene(
      "case2", {"structure.stiffness_damping=1.25e-6", "contact.gap=1e-4", "forcing.frequency=2800"}));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "unstable");
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "unstable_multipliers"), 1);
  EXPECT_LT(value_of<double>(record.summary, "leading_multiplier_real"), -1.0);
  EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_imag"), 0.0, 1e-9);
  EXPECT_TRUE(std::any_of(record.warnings.begin(), record.warnings.end(), [](const std::string& text) {
    return text.find("unstable") != std::string::npos;
  }));
}

TEST(RecordOfAResponse, ThatIsUnstableSaysWhatTheStructureSettlesToInItsPlace) {
  const Record record = analyse(load_scene(
      WAVEBALANCE_SCENES "/cases_of_others/oscillator_with_stop.toml",
      std::vector<std::string>{"analysis.type=forced_response", "forcing.frequency=0.3978873577"},
      std::vector<std::string>{"analysis.branches", "analysis.frequency_from", "analysis.frequency_to"}));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "unstable_multipliers"), 1);
  // Behind a period doubling: a motion of two periods, which goes farther.
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "settled_periods"), 2);
  EXPECT_GT(value_of<double>(record.summary, "settled_max_displacement_m"),
            value_of<double>(record.summary, "max_displacement_m"));
  EXPECT_TRUE(std::any_of(record.warnings.begin(), record.warnings.end(), [](const std::string& text) {
    return text.find("settles to another motion, which repeats after 2 periods") != std::string::npos;
  }));
  EXPECT_FALSE(holds(analyse(fourier_scene("case2", {"forcing.frequency=1275"})).summary, "settled_periods"));
}

// Reference: shooting made independently of this code.
TEST(RecordOfAResponse, HoldsTheLeadingMultiplierOfAStableMotion) {
  const Record record = analyse(fourier_scene("case2", {"forcing.frequency=1275"}));
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "unstable_multipliers"), 0);
  EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_real"), 0.57073047, 2e-3);
  EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_imag"), 0.19792202, 2e-3);
}

TEST(RecordOfAResponse, WithRigidContactIsStableAndWithoutDampingSaysThatThisIsNotKnown) {
  const Record rigid = analyse(fourier_scene("case1_rigid", {}));
  EXPECT_EQ(value_of<std::string>(rigid.summary, "stability"), "stable");
  const Record undamped = analyse(fourier_scene("case1", {"structure.stiffness_damping=0"}));
  EXPECT_EQ(value_of<std::string>(undamped.summary, "stability"), "undamped");
  EXPECT_TRUE(std::isnan(value_of<double>(undamped.summary, "unstable_multipliers")));
}

TEST(RecordOfAResponse, HoldsNoStabilityWhereTheSceneWantsNone) {
  const Record record = analyse(fourier_scene("case1", {"analysis.stability=false"}));
  EXPECT_FALSE(holds(record.summary, "stability"));
  EXPECT_FALSE(holds(record.summary, "unstable_multipliers"));
}

TEST(RecordOfASweep, ListsItsSpecialPointsAndTheStabilityOfEachPoint) {
  const Record record = analyse(fourier_scene("case2_sweep", {}));
  const Table special = value_of<Table>(record.summary, "special_points");
  EXPECT_EQ(special.texts("type"), (std::vector<std::string>{"grazing", "fold", "fold", "grazing"}));
  const auto turns = value_of<std::vector<double>>(record.summary, "turning_points_Hz");
  EXPECT_EQ(value_of<std::string>(record.summary, "structure_curve"), "whole");
  const Table folds = value_of<Table>(record.summary, "structure_special_points").where("type", "fold");
  EXPECT_EQ(turns, folds.numbers("frequency_Hz"));
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_NEAR(turns[0], special.numbers("frequency_Hz")[1], 1e-5 * turns[0]);
  EXPECT_NEAR(turns[1], special.numbers("frequency_Hz")[2], 1e-5 * turns[1]);
  const auto unstable = record.sweep.numbers("unstable"), contacts = record.sweep.numbers("contacts");
  const auto frequency = record.sweep.numbers("frequency_Hz");
  for (std::size_t i = 0; i < unstable.size(); ++i) {
    EXPECT_TRUE(std::isnan(unstable[i]) || unstable[i] == 0.0 || unstable[i] == 1.0) << frequency[i];
    if (unstable[i] != 1.0) continue;
    EXPECT_GT(frequency[i], 1314.0);
    EXPECT_LT(frequency[i], 1338.0);
    EXPECT_EQ(contacts[i], 1.0);
  }
  EXPECT_GT(std::count(unstable.begin(), unstable.end(), 1.0), 3);
  // Solid and dashed lines of two quantities, and two kinds of points.
  EXPECT_EQ(record.figure.panels.front().series.size(), 6u);
}

// With 256 points the lower fold, 0.002 Hz beside a grazing, is not among the folds found.
TEST(RecordOfASweep, WarnsWhereItsTurningPointsCannotBeAll) {
  const Record record = analyse(fourier_scene("case2_sweep", {"time.quadrature_points=256"}));
  ASSERT_EQ(record.status, "reached_end");
  const auto turns = value_of<std::vector<double>>(record.summary, "turning_points_Hz");
  const bool warned = std::any_of(record.warnings.begin(), record.warnings.end(), [](const auto& text) {
    return text.find("a curve with this end turns an even number of times") != std::string::npos;
  });
  EXPECT_EQ(warned, turns.size() % 2 == 1) << turns.size();
  for (const std::string& text : record.warnings)
    EXPECT_EQ(text.find("the other turns are an error"), std::string::npos) << text;
}

TEST(RecordOfASweep, WithoutSpecialPointsHasTheSameCounts) {
  const Record all = analyse(fourier_scene("case2_sweep", {}));
  const Record counts = analyse(fourier_scene("case2_sweep", {"analysis.special_points=false"}));
  EXPECT_EQ(counts.status, "reached_end");
  EXPECT_FALSE(holds(counts.summary, "special_points"));
  EXPECT_FALSE(holds(counts.summary, "structure_special_points"));
  EXPECT_EQ(value_of<std::vector<double>>(counts.summary, "turning_points_Hz").size(), 2u);
  const auto expected = all.sweep.numbers("unstable"), found = counts.sweep.numbers("unstable");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_TRUE(found[i] == expected[i] || std::isnan(expected[i])) << i;
  EXPECT_GT(std::count(found.begin(), found.end(), 1.0), 3);
}

TEST(RecordOfASweep, WhoseSpecialPointsAreWantedCannotLeaveThemOut) {
  const auto expect_refused = [](const std::string& other) {
    try {
      fourier_scene("case2_sweep", {"analysis.special_points=false", other});
      ADD_FAILURE() << other;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("analysis.special_points = true"), std::string::npos)
          << error.what();
    }
  };
  for (const char* other :
       {"analysis.branches=true", "analysis.motion_at=\"special\"", "analysis.exact=true"})
    expect_refused(other);
}

TEST(RecordOfASweep, WithoutStabilityHasTheTurningPointsOfTheSamples) {
  const Record record = analyse(fourier_scene("case2_sweep", {"analysis.stability=false"}));
  EXPECT_FALSE(holds(record.summary, "special_points"));
  EXPECT_EQ(value_of<std::vector<double>>(record.summary, "turning_points_Hz").size(), 2u);
  EXPECT_FALSE(record.sweep.has_column("unstable"));
  EXPECT_EQ(record.figure.panels.front().series.size(), 2u);
}

}  // namespace
}  // namespace wavebalance::app
