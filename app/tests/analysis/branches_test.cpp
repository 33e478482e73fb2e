// Motions of several periods of the load, and branches, as records, tables and pictures hold them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// m = k = 1, c = 0.1, a stop of 10 N/m at 0.1 m, 0.8 N: a bar of one element. Its motion of one period is
/// unstable between the period doublings at 2.206199894019 and 2.973736781998 rad/s.
const std::string oscillator = R"([structure]
type = "bar"
youngs_modulus = 1.0
density = 2.0
area = 1.0
length = 1.0
elements = 1
lumped_mass_fraction = 1.0
stiffness_damping = 0.1
[contact]
law = "linear"
stiffness = 10.0
gap = 0.1
[forcing]
amplitude = 0.8
frequency = 0.4297183463481174
[time]
trial = "fourier"
weight = "fourier"
functions = 125
quadrature_points = 1024
[analysis]
type = "forced_response"
)";

Scene scene_with(const std::vector<std::string>& overrides) {
  return parse_scene(oscillator, "case.toml", overrides);
}

Scene sweep_with(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(),
                   {"time.functions=63", "time.quadrature_points=512", "analysis.type=frequency_sweep",
                    "analysis.frequency_from=0.33", "analysis.frequency_to=0.5"});
  return scene_with(overrides);
}

// At 2.7 rad/s. Of both halves of the time one load period is the other's but for the doubling.
TEST(SubharmonicScene, HasAMotionOfTwoPeriodsOfTheLoad) {
  const Record record = analyse(scene_with({"analysis.subharmonic=2", "analysis.output_points=2048"}));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "frequency_Hz"), 2.7 / two_pi, 1e-12);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "subharmonic"), 2);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "period_of_motion"), 2);
  EXPECT_GT(value_of<double>(record.summary, "change_after_one_period"), 1.0);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_EQ(record.figure.panels[0].x.label, "Time (fraction of 2 periods of the load)");
  // The velocity is that of the time column.
  const auto u = record.response.numbers("displacement_m"), v = record.response.numbers("velocity_m_per_s");
  const double step = 2.0 * two_pi / 2.7 / 2048;
  for (std::size_t i = 1; i + 1 < u.size(); i += 97)
    EXPECT_NEAR((u[i + 1] - u[i - 1]) / (2.0 * step), v[i], 1e-3);
}

// The motion of one period is one of three periods, too, and at 2 rad/s no other is found.
TEST(SubharmonicScene, SaysThatTheMotionFoundHasAShorterPeriod) {
  const Record record =
      analyse(scene_with({"analysis.subharmonic=3", "forcing.frequency=0.3183098861837907"}));
  ASSERT_TRUE(record.converged);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "period_of_motion"), 1);
  EXPECT_TRUE(warns(record, "repeats after one period"));
}

TEST(SubharmonicScene, WithoutContactIsTheOrdinaryResponse) {
  for (const std::string basis : {"fourier", "haar"}) {
    const std::vector<std::string> pair{"time.trial=" + basis, "time.functions=64",
                                        "time.quadrature_points=512", "contact.gap=1e3"};
    std::vector<std::string> doubled = pair;
    doubled.insert(doubled.end(), {"analysis.subharmonic=2", "time.functions=128",
                                   "time.quadrature_points=1024", "analysis.output_points=2048"});
    const auto once = analyse(scene_with(pair)).response.numbers("displacement_m");
    const Record twice = analyse(scene_with(doubled));
    const auto u = twice.response.numbers("displacement_m");
    ASSERT_EQ(u.size(), 2 * once.size());
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], once[i % once.size()], 1e-13);
    EXPECT_EQ(value_of<std::int64_t>(twice.summary, "period_of_motion"), 1);
  }
}

// At 2.7 rad/s from rest.
TEST(TimeSteppingRecord, SaysAfterHowManyPeriodsAMotionRepeats) {
  const Record record = analyse(scene_with({"analysis.type=time_stepping"}));
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status, "subharmonic");
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "attractor_periods"), 2);
  EXPECT_TRUE(warns(record, "analysis.subharmonic = 2"));
}

// The force form. Its points are no multiple of three, so that a motion of one period repeats to 1e-4 only.
TEST(SubharmonicScene, WithRigidContactSaysThatItsMotionHasOnePeriod) {
  const std::vector<std::string> overrides{"analysis.subharmonic=3", "time.functions=127",
                                           "time.quadrature_points=1024"};
  const Record record =
      analyse(load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case2_rigid.toml", overrides));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "period_of_motion"), 1);
  EXPECT_GT(value_of<double>(record.summary, "change_after_one_period"), 1e-8);
  EXPECT_LT(value_of<double>(record.summary, "change_after_one_period"), 2e-4);
}

// Frequencies are those of the load. The sweep starts on the motion of two periods at 2.7 rad/s, which turns
// back at 3.0243 rad/s.
TEST(SubharmonicSweep, FollowsTheMotionOfTwoPeriods) {
  const Record record =
      analyse(sweep_with({"analysis.subharmonic=2", "time.functions=125", "time.quadrature_points=1024",
                          "analysis.frequency_from=0.4297183463481174", "analysis.frequency_to=0.5"}));
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "period_of_motion"), 2);
  const auto frequency = record.sweep.numbers("frequency_Hz");
  EXPECT_NEAR(frequency.front(), 2.7 / two_pi, 1e-12);
  const auto turns = value_of<std::vector<double>>(record.summary, "turning_points_Hz");
  ASSERT_FALSE(turns.empty());
  EXPECT_NEAR(two_pi * turns.front(), 3.02430, 2e-4);
  const Table special = value_of<Table>(record.summary, "special_points");
  ASSERT_FALSE(special.texts("type").empty());
  EXPECT_EQ(special.texts("type").front(), "fold");
  EXPECT_NEAR(special.numbers("frequency_Hz").front(), turns.front(), 1e-5 * turns.front());
}

TEST(SweepWithBranches, WritesEveryCurveWithItsPeriod) {
  const Record record = analyse(sweep_with({"analysis.branches=true"}));
  ASSERT_TRUE(record.converged) << record.status;
  const Table branches = value_of<Table>(record.summary, "branches");
  ASSERT_EQ(branches.rows(), 2u);
  EXPECT_NEAR(two_pi * branches.numbers("frequency_Hz")[0], 2.206199894019, 1e-4);
  EXPECT_NEAR(two_pi * branches.numbers("end_frequency_Hz")[0], 2.973736781998, 1e-4);
  EXPECT_EQ(branches.texts("end"), (std::vector<std::string>{"special_point", "special_point"}));
  EXPECT_EQ(branches.numbers("period"), (std::vector<double>{2.0, 4.0}));
  const auto branch = record.sweep.numbers("branch"), period = record.sweep.numbers("period");
  const auto frequency = record.sweep.numbers("frequency_Hz"), unstable = record.sweep.numbers("unstable");
  const std::set<double> numbers(branch.begin(), branch.end());
  EXPECT_EQ(numbers, (std::set<double>{0.0, 1.0, 2.0}));
  for (std::size_t i = 0; i < branch.size(); ++i) {
    EXPECT_EQ(period[i], branch[i] == 0.0 ? 1.0 : 2.0 * branch[i]);
    EXPECT_GT(two_pi * frequency[i], 2.07);
    EXPECT_LT(two_pi * frequency[i], 3.15);
    if (branch[i] == 0.0 && two_pi * frequency[i] > 2.21 && two_pi * frequency[i] < 2.97) {
      EXPECT_EQ(unstable[i], 1.0);
    }
  }
}

// Their motions of two periods have twice the functions and points, so that one of the curve repeated is one.
TEST(SweepWithBranches, IsThatOfEveryPairOfBases) {
  using Pair = std::vector<std::string>;
  for (const Pair& pair :
       {Pair{"bspline", "bspline"}, Pair{"daubechies6", "bspline"}, Pair{"fourier", "fourier"}}) {
    SCOPED_TRACE(pair[0] + ":" + pair[1]);
    const Record record = analyse(sweep_with(
        {"analysis.branches=true", "time.trial=" + pair[0], "time.weight=" + pair[1], "time.functions=64"}));
    const Table branches = value_of<Table>(record.summary, "branches");
    ASSERT_EQ(branches.rows(), 2u);
    EXPECT_NEAR(two_pi * branches.numbers("frequency_Hz")[0], 2.206199894019, 2e-4);
    EXPECT_NEAR(two_pi * branches.numbers("end_frequency_Hz")[0], 2.973736781998, 2e-4);
    EXPECT_EQ(branches.numbers("period"), (std::vector<double>{2.0, 4.0}));
  }
}

TEST(SweepWithBranches, IsDrawnWithAColourForEachAndUnstablePartsDashed) {
  const Record record = analyse(sweep_with({"analysis.branches=true"}));
  const auto& series = record.figure.panels[0].series;
  const auto labelled = [&](const std::string& label) {
    return std::find_if(series.begin(), series.end(), [&](const Series& one) { return one.label == label; });
  };
  const auto first = labelled("branch 1, 2 periods"), second = labelled("branch 2, 4 periods");
  ASSERT_NE(first, series.end());
  ASSERT_NE(second, series.end());
  EXPECT_NE(first->colour, second->colour);
  EXPECT_EQ(first->dash, Dash::solid);
  const auto dashed = std::next(first);
  EXPECT_EQ(dashed->dash, Dash::dashed);
  EXPECT_EQ(dashed->colour, first->colour);
  EXPECT_NE(labelled("period doubling"), series.end());
}

TEST(SweepWithBranches, SaysThatItWasInterruptedOnABranch) {
  bool main_is_done = false;
  const Record record = analyse(sweep_with({"analysis.branches=true"}), [&](const Progress& progress) {
    main_is_done = main_is_done || progress.phase == "stability";
    return !(main_is_done && progress.phase == "frequency sweep");
  });
  EXPECT_TRUE(record.interrupted);
  EXPECT_EQ(value_of<Table>(record.summary, "branches").texts("end"),
            std::vector<std::string>{"interrupted"});
}

TEST(CheckOfAScene, NamesThePeriodsAndTheBranches) {
  const std::string text = describe_scene(sweep_with({"analysis.branches=true", "analysis.subharmonic=2"}));
  EXPECT_NE(text.find("motions of 2 periods, with branches"), std::string::npos) << text;
}

TEST(SweepWithoutBranches, HasTheColumnsOfOneCurve) {
  const Record record = analyse(sweep_with({}));
  EXPECT_EQ(record.sweep.columns(),
            (std::vector<std::string>{"frequency_Hz", "max_displacement_m", "rms_displacement_m",
                                      "min_displacement_m", "max_abs_displacement_m", "max_contact_force_N",
                                      "contact_fraction", "vibration_m", "rms_vibration_m", "unstable",
                                      "contacts"}));
}

TEST(Sweep, WarnsThatMotionsBecomeQuasiPeriodicAtNeimarkSackerPoints) {
  const std::vector<std::string> overrides{"time.trial=fourier",
                                           "time.weight=fourier",
                                           "time.functions=63",
                                           "structure.stiffness_damping=5e-7",
                                           "analysis.frequency_from=1308",
                                           "analysis.frequency_to=1342"};
  const Record record =
      analyse(load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case2_sweep.toml", overrides));
  EXPECT_TRUE(warns(record, "quasi-periodic"));
  EXPECT_TRUE(warns(record, "1312."));
}

// That of two periods which begins just after contact does, at 2734.17 Hz.
TEST(SweepWithBranches, WarnsOfNeimarkSackerPointsOnBranchesToo) {
  const std::vector<std::string> overrides{"time.trial=fourier",
                                           "time.weight=fourier",
                                           "time.functions=63",
                                           "time.quadrature_points=512",
                                           "structure.stiffness_damping=1.25e-6",
                                           "contact.gap=1e-4",
                                           "analysis.frequency_from=2550",
                                           "analysis.frequency_to=3000",
                                           "analysis.branches=true"};
  const Record record =
      analyse(load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case2_sweep.toml", overrides));
  EXPECT_TRUE(warns(record, "2916."));
}

TEST(SceneWithSeveralPeriods, RefusesWhatHasNone) {
  const auto message = [](const std::vector<std::string>& overrides) {
    return message_of(oscillator, overrides);
  };
  const auto expect_parts = [](const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_parts(message({"analysis.subharmonic=0"}), {"analysis.subharmonic = 0", "1..1024"});
  expect_parts(message({"analysis.subharmonic=\"two\""}), {"analysis.subharmonic = \"two\"", "integer"});
  expect_parts(message({"analysis.subharmonic=2.5"}), {"analysis.subharmonic = 2.5", "integer"});
  expect_parts(message({"analysis.subharmonic=63"}), {"analysis.subharmonic = 63", "<= 62"});
  expect_parts(message({"analysis.branches=true"}), {"analysis.branches = true", "frequency_sweep"});
  expect_parts(message({"analysis.type=time_stepping", "analysis.subharmonic=2"}),
               {"analysis.subharmonic = 2", "forced_response"});
  const std::vector<std::string> sweep{"analysis.type=frequency_sweep", "analysis.frequency_from=0.3",
                                       "analysis.frequency_to=0.4", "analysis.branches=true"};
  const auto of_sweep = [&](std::vector<std::string> more) {
    more.insert(more.begin(), sweep.begin(), sweep.end());
    return message(more);
  };
  expect_parts(of_sweep({"analysis.branches=1"}), {"analysis.branches = 1", "true or false"});
  expect_parts(of_sweep({"analysis.stability=false"}),
               {"analysis.branches = true", "analysis.stability = true"});
  std::string rigid = with(oscillator, "law = \"linear\"\nstiffness = 10.0", "law = \"rigid\"");
  rigid = with(with(rigid, "elements = 1", "elements = 2"), "stiffness_damping",
               "massless_tip = true\nstiffness_damping");
  expect_parts(message_of(rigid, sweep), {"analysis.branches = true", "rigid"});
  expect_parts(message_of(tolerance_scene("1e-3"), {"analysis.subharmonic=2"}),
               {"analysis.subharmonic = 2", "time.tolerance"});
}

}  // namespace
}  // namespace wavebalance::app
