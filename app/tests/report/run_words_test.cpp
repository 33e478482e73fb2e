#include "report/run_words.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "plot/unit_prefix.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::app {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text += sentence + " ";
  return text;
}

Summary motion(bool converged) {
  return {{"converged", converged},
          {"status", std::string(converged ? "converged" : "stalled_at_start")},
          {"residual", 1e-12},
          {"wall_seconds", 0.0025},
          {"max_displacement_m", 1.02e-3},
          {"min_displacement_m", -1.4e-3},
          {"max_contact_force_N", 79218.0},
          {"contact_fraction", 0.25},
          {"analysis", std::string("forced_response")},
          {"frequency_Hz", 150.0}};
}

TEST(RunWords, PeaksHaveTheDigitsThatThePointsOfTheirCurveDetermine) {
  Summary curve = motion(true);
  for (auto& entry : curve)
    if (entry.name == "analysis") entry.value = std::string("frequency_sweep");
  curve.insert(curve.end(), {{"points", std::int64_t{20}},
                             {"vibration_m", 1.21234e-3},
                             {"frequency_at_largest_vibration_Hz", 1013.9},
                             {"frequency_at_max_displacement_Hz", 1013.9},
                             {"peak_value_resolution", 2e-3},
                             {"peak_place_resolution", 3.0},
                             {"displacement_unit", std::string("rad")}});
  const std::string text = joined(outcome_sentences(curve, 1e-3, {"frequency", "Hz"}));
  EXPECT_NE(text.find("is 1.21 mrad (half peak to peak), at 1010 Hz."), std::string::npos) << text;
  EXPECT_NE(text.find("The largest displacement is 1.02 mrad, at 1010 Hz, "), std::string::npos) << text;
}

TEST(RunWords, QuantitiesHaveAPrefixThatMakesThemReadable) {
  EXPECT_EQ(quantity(1.02e-3, "m"), "1.02 mm");
  EXPECT_EQ(quantity(-1.4e-3, "m"), "-1.4 mm");
  EXPECT_EQ(quantity(79218.0, "N"), "79.22 kN");
  EXPECT_EQ(quantity(0.0, "m"), "0 m");
  EXPECT_EQ(quantity(1327.9, "Hz"), "1328 Hz");
  EXPECT_EQ(quantity(0.1909859, "Hz"), "0.191 Hz");
  EXPECT_EQ(quantity(unknown, "N"), "not known");
}

TEST(RunWords, AMotionIsToldWithItsContactAndItsDistanceFromTheGap) {
  const std::string text = joined(outcome_sentences(motion(true), 1e-3));
  for (const char* words : {"was solved, in 2.5 ms", "1e-12", "At 150 Hz", "-1.4 mm and 1.02 mm",
                            "2 % past the gap of 1 mm", "25 % of the period", "79.22 kN"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST(RunWords, WhatHasNotConvergedIsCalledNoSolution) {
  const std::string text = joined(outcome_sentences(motion(false), unknown));
  EXPECT_NE(text.find("was not solved (stalled at start)"), std::string::npos) << text;
  EXPECT_NE(text.find("not a solution"), std::string::npos) << text;
  EXPECT_EQ(text.find("gap"), std::string::npos) << text;
}

TEST(RunWords, WithoutAMotionNothingIsSaidToFollow) {
  Summary none = motion(false);
  for (Entry& one : none)
    if (one.name.ends_with("_m") || one.name.ends_with("_N") || one.name == "contact_fraction")
      one.value = unknown;
  const std::string text = joined(outcome_sentences(none, unknown));
  EXPECT_NE(text.find("There is no motion to show."), std::string::npos) << text;
  EXPECT_EQ(text.find("is not a solution"), std::string::npos) << text;
}

TEST(RunWords, WordsOfModesAreExplainedWhereTheyStand) {
  const Summary mode{{"converged", true},
                     {"status", std::string("converged")},
                     {"analysis", std::string("nonlinear_mode")},
                     {"mode", std::int64_t{1}},
                     {"points", std::int64_t{20}},
                     {"points_tongue", std::int64_t{2}},
                     {"largest_energy_ratio", 3.0},
                     {"virial_residual", 1.5e-5}};
  const std::string text = joined(outcome_sentences(mode, unknown));
  EXPECT_NE(text.find("A tongue is a part of the curve on an internal resonance"), std::string::npos) << text;
  EXPECT_NE(text.find("The virial residual, at most 1.5e-05, is the relative error"), std::string::npos)
      << text;
  Table points({"type", "frequency_Hz"});
  points.append_row({std::string("krein_collision"), 2.0});
  const std::string stability =
      joined(stability_sentences({{"stability", std::string("converged")}, {"special_points", points}}));
  EXPECT_NE(
      stability.find("Krein collisions, where two pairs of multipliers meet on the unit circle and leave it"),
      std::string::npos)
      << stability;
}

TEST(RunWords, EveryStatusOfStabilityHasASentenceOfItsOwn) {
  using solvers::StabilityStatus;
  std::vector<std::string> statuses{"stable", "unstable", "no_modes", "no_law_of_impact", "interrupted"};
  for (int i = 0; i <= static_cast<int>(StabilityStatus::effort_limit); ++i)
    statuses.emplace_back(to_string(static_cast<StabilityStatus>(i)));
  for (const auto& status : statuses) {
    const std::string text = joined(stability_sentences({{"stability", status}}));
    EXPECT_EQ(text.find("known ("), std::string::npos) << text;
    EXPECT_FALSE(text.empty()) << status;
  }
  EXPECT_EQ(stability_sentences({{"stability", std::string("other_reason")}}).at(0),
            "Stability is not known (other reason).");
  EXPECT_TRUE(stability_sentences({}).empty());
}

TEST(RunWords, SpecialPointsAreListedByType) {
  Table points({"type", "frequency_Hz"});
  points.append_row({std::string("fold"), 1337.7681796});
  points.append_row({std::string("grazing"), 1226.7});
  points.append_row({std::string("fold"), 1315.015});
  const std::string text =
      joined(stability_sentences({{"stability", std::string("converged")}, {"special_points", points}}));
  EXPECT_NE(text.find("Folds, where the curve turns back: 1337.768 Hz, 1315.015 Hz."), std::string::npos)
      << text;
  EXPECT_NE(text.find("joins another: 1226.7 Hz."), std::string::npos) << text;
}

TEST(RunWords, SpecialPointsAreThoseOfTheStructureWhereItsWholeCurveIsKnown) {
  Table balance({"type", "frequency_Hz"}), structure({"type", "frequency_Hz"});
  balance.append_row({std::string("fold"), 1337.7681796});
  structure.append_row({std::string("fold"), 1337.739426});
  for (const bool whole : {true, false}) {
    const std::string text =
        joined(stability_sentences({{"stability", std::string("converged")},
                                    {"special_points", balance},
                                    {"structure_curve", std::string(whole ? "whole" : "stretches")},
                                    {"structure_special_points", structure}}));
    EXPECT_NE(text.find(whole ? "back: 1337.739 Hz." : "back: 1337.768 Hz."), std::string::npos) << text;
  }
}

TEST(RunWords, UnstablePartsOfACurveAndOfItsBranchesAreNamed) {
  Table parts({"branch", "begin_Hz", "end_Hz"});
  parts.append_row({std::int64_t{0}, 11.0, 10.5});
  parts.append_row({std::int64_t{0}, 13.0, 13.0});
  parts.append_row({std::int64_t{2}, 11.5, 11.75});
  const std::string text =
      joined(stability_sentences({{"stability", std::string("partly_known")},
                                  {"points", std::int64_t{6}},
                                  {"points_stability_not_known", std::int64_t{1}},
                                  {"stability_not_known", std::string("too_few_samples")},
                                  {"unstable_parts", parts}}));
  for (const char* words : {"Along the curve motions are unstable at 11 to 10.5 Hz, 13 Hz.",
                            "Along branch 2 motions are unstable at 11.5 to 11.75 Hz.",
                            "Stability is known at 5 of 6 points. Where contact has just begun"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

}  // namespace
}  // namespace wavebalance::app
