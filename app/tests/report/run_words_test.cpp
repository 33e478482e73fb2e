#include "report/words.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::app {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text += sentence + " ";
  return text;
}

Summary motion() {
  return {{"converged", true},
          {"status", std::string("converged")},
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
  Summary curve = motion();
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

TEST(RunWords, KreinCollisionsAreExplainedWhereTheyStand) {
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

TEST(RunWords, SpecialPointsAreThoseOfTheBalanceWhereTheCurveOfTheStructureIsKnownInStretches) {
  Table balance({"type", "frequency_Hz"}), structure({"type", "frequency_Hz"});
  balance.append_row({std::string("fold"), 1337.7681796});
  structure.append_row({std::string("fold"), 1337.739426});
  const std::string text = joined(stability_sentences({{"stability", std::string("converged")},
                                                       {"special_points", balance},
                                                       {"structure_curve", std::string("stretches")},
                                                       {"structure_special_points", structure}}));
  EXPECT_NE(text.find("back: 1337.768 Hz."), std::string::npos) << text;
}

TEST(RunWords, AnUnstablePartOfOnePointIsNamedByIt) {
  Table parts({"branch", "begin_Hz", "end_Hz"});
  parts.append_row({std::int64_t{0}, 11.0, 10.5});
  parts.append_row({std::int64_t{0}, 13.0, 13.0 - 1e-9});
  const std::string text =
      joined(stability_sentences({{"stability", std::string("partly_known")},
                                  {"points", std::int64_t{6}},
                                  {"points_stability_not_known", std::int64_t{1}},
                                  {"stability_not_known", std::string("too_few_samples")},
                                  {"unstable_parts", parts}}));
  EXPECT_NE(text.find("Along the curve motions are unstable at 11 to 10.5 Hz, 13 Hz."), std::string::npos)
      << text;
}

}  // namespace
}  // namespace wavebalance::app
