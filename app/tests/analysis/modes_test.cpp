#include "wavebalance/app/analysis/modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;
using wavebalance::solvers::ModeStatus;

Scene rod(const std::vector<std::string>& overrides = {}) {
  return parse_scene(rod_scene, "rod.toml", overrides);
}

TEST(ModeStudy, LinearFrequencyIsThatOfThePaper) {
  const ModeStudy study(rod({"structure.lumped_mass_fraction=0"}));
  EXPECT_NEAR(study.linear_frequency(), 1297.5197, 1e-4);  // found independently
  EXPECT_NEAR(study.mode().model().omega_squared[1] / study.mode().model().omega_squared[0],
              3.00617 * 3.00617, 1e-4);
}

TEST(ModeStudy, FollowsTheExactModeWithinOnePercentOffInternalResonances) {
  const ModeStudy study(rod());
  const Backbone curve = study.backbone();
  // By d'Alembert's formula: ExactBarMode of reproduce/laxalde_legrand_2010/modes, with the energy of LL10.
  constexpr std::pair<double, double> exact_ratios[] = {
      {1.8, 1.1025577713}, {3.0, 1.1539553372}, {5.0, 1.1946476340}, {10.0, 1.2358187757}};
  for (const auto& [energy, exact] : exact_ratios) {
    const auto point = study.at_energy(curve, energy);
    ASSERT_EQ(point.status, ModeStatus::converged) << energy;
    EXPECT_NEAR(point.omega / study.mode().linear_omega(), exact, 0.01 * exact) << energy;
  }
}

TEST(ModeStudy, EquationOfMotionHoldsAtEveryAcceptedPoint) {
  const Backbone curve = ModeStudy(rod()).backbone();
  ASSERT_EQ(curve.points.size(), curve.residuals.size());
  for (std::size_t i = 0; i < curve.points.size(); ++i)
    if (curve.points[i].accepted()) {
      EXPECT_LT(curve.residuals[i], 1e-9);
      EXPECT_LT(curve.points[i].virial_residual, 1e-12);
    }
}

TEST(ModeStudy, SamplesAreTheMotion) {
  const ModeStudy study(rod());
  const auto point = study.at_energy(1.8);
  const auto tip = study.contact_motion(point, 1024), all = study.structure_motion(point, 1024);
  EXPECT_EQ(all.rows(), 20);
  const double scale = tip.displacement.cwiseAbs().maxCoeff();
  EXPECT_LT((all.displacement.row(19) - tip.displacement).cwiseAbs().maxCoeff(), 1e-12 * scale);
  EXPECT_NEAR(tip.displacement.maxCoeff(), 1e-3 * (1.0 + point.max_penetration), 1e-6);
  // A central difference of a motion with 10 harmonics: its error is (2 pi 10/1024)^2/6 of the tenth at most.
  const double rate = 1024.0 * point.omega / (2.0 * std::numbers::pi) / 2.0;
  for (int l = 1; l + 1 < 1024; ++l)
    EXPECT_NEAR(tip.velocity(0, l), rate * (tip.displacement(0, l + 1) - tip.displacement(0, l - 1)),
                1e-3 * tip.velocity.cwiseAbs().maxCoeff());
}

TEST(ModeStudy, DoesNotDependOnTheGap) {
  const ModeStudy study(rod()), wide(rod({"contact.gap=0.5"}));
  EXPECT_NEAR(wide.at_energy(3.0).omega, study.at_energy(3.0).omega, 1e-6 * study.mode().linear_omega());
}

TEST(Backbone, FailureOnNoInternalResonanceIsNotConverged) {
  Backbone curve;
  EXPECT_FALSE(curve.converged());
  curve.points.resize(1);
  curve.points[0].status = ModeStatus::converged;
  EXPECT_TRUE(curve.converged());
  curve.interruptions.push_back({1.1, 1.2, {"3:2"}, "cycling", true});
  EXPECT_TRUE(curve.converged());
  curve.interruptions.push_back({1.25, 1.25, {}, "cycling", true});
  EXPECT_FALSE(curve.converged());
  EXPECT_NE(curve.status().find("cycling at frequency ratio 1.25"), std::string::npos) << curve.status();
}

TEST(Analyse, RigidBackboneThatEndsBeforeItsEnergyIsNotConvergedAndSaysWhereItEnds) {
  // Few points of the second mode lie on no internal resonance, none beyond 1.04 times its linear frequency.
  const Record record = analyse(rod({"analysis.mode=2"}));
  EXPECT_FALSE(record.converged);
  EXPECT_NE(record.status.find("ended at frequency ratio 1.0"), std::string::npos) << record.status;
  EXPECT_NE(record.status.find("before the energy ratio 10 asked for: beyond it lies the internal resonance"),
            std::string::npos)
      << record.status;
  EXPECT_NE(record.figure.title.find("INCOMPLETE"), std::string::npos);
}

TEST(Analyse, RigidBackboneBelowItsEnergyAtTheLastFrequencyIsConvergedAndSaysSo) {
  const Record record = analyse(rod({"analysis.last_frequency_ratio=1.05", "analysis.points=50"}));
  EXPECT_TRUE(record.converged);
  EXPECT_NE(record.status.find("ended at frequency ratio 1.0500"), std::string::npos) << record.status;
  EXPECT_NE(record.status.find("last_frequency_ratio is reached"), std::string::npos) << record.status;
}

// Some points of the rod cycle with 40 samples for 15 harmonics, beside internal resonances.
TEST(Analyse, PointsWithoutAMotionAreAWarningWithTheirNumberAndPlaces) {
  const Record record = analyse(rod({"analysis.harmonics=15", "analysis.samples=40", "analysis.points=100"}));
  const auto count = [&](const std::string& of) { return value_of<std::int64_t>(record.summary, of); };
  const std::int64_t failed = count("points_cycling") + count("points_no_contact") + count("points_singular");
  ASSERT_GT(failed, 0);
  EXPECT_TRUE(warns(record, std::to_string(failed) + " of " + std::to_string(count("points")) +
                                " points of the curve no motion was found"))
      << testing::PrintToString(record.warnings);
  EXPECT_TRUE(warns(record, std::to_string(count("points_cycling")) + " cycling"));
  EXPECT_TRUE(warns(record, "at frequency ratios 1."));
  EXPECT_EQ(value_of<std::vector<std::string>>(record.summary, "warnings"), record.warnings);
}

TEST(Analyse, ACurveOfWhichAllPointsAreMotionsHasNoWarning) {
  const Record record = analyse(rod({"analysis.last_frequency_ratio=1.05", "analysis.points=50"}));
  EXPECT_TRUE(record.warnings.empty());
}

TEST(Analyse, BackboneHoldsLinearBranchAndContact) {
  const Record record = analyse(rod());
  EXPECT_TRUE(record.converged) << record.status;
  const auto energy = record.backbone.numbers("energy_ratio");
  const auto ratio = record.backbone.numbers("frequency_ratio");
  const auto quotient = record.backbone.numbers("rayleigh_frequency_ratio");
  const auto statuses = record.backbone.texts("status");
  EXPECT_EQ(energy[0], 0.0);
  for (std::size_t i = 0; i < energy.size(); ++i) {
    if (statuses[i] == "linear") {
      EXPECT_DOUBLE_EQ(ratio[i], 1.0);
    }
    if (statuses[i] == "converged") {
      EXPECT_LE(quotient[i], ratio[i]);
    }
    if (statuses[i] == "cycling") {
      EXPECT_TRUE(std::isnan(energy[i]));
    }
  }
  EXPECT_LT(value_of<double>(record.summary, "residual"), 1e-9);
  EXPECT_GE(value_of<double>(record.summary, "largest_energy_ratio"), 10.0);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "points"),
            static_cast<std::int64_t>(std::count_if(statuses.begin(), statuses.end(),
                                                    [](const auto& s) { return s != "linear"; })));
}

TEST(Analyse, EnergyBelowContactIsTheLinearMode) {
  const Record record = analyse(rod({"analysis.energy_ratio=0.25"}));
  EXPECT_TRUE(record.converged);
  EXPECT_EQ(record.status, "linear");
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 0.5e-3, 1e-12);
  EXPECT_EQ(value_of<double>(record.summary, "max_contact_force_N"), 0.0);
  EXPECT_EQ(value_of<double>(record.summary, "frequency_ratio"), 1.0);
}

TEST(ModeScene, FormulationIsRefusedWithThePlaceWhereThePublishedEquationsAreSolved) {
  try {
    rod({"analysis.formulation=published"});
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    const std::string message = error.what();
    for (const char* part : {"analysis.formulation", "published", "reproduce/laxalde_legrand_2010"})
      EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
}

TEST(ModeScene, ConsistentFormulationOfAnEarlierRecordIsAccepted) {
  EXPECT_EQ(rod({"analysis.formulation=consistent"}), rod());
}

Scene rigid_bar(const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all{"time.quadrature_points=128", "structure.massless_tip=true"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return parse_scene(
      with(with(with(bar_scene, "\"exponential\"", "\"rigid\""), "constant = 1e8  ", "# "), "exponent", "#"),
      "rigid.toml", all);
}

TEST(MakeStructure, MasslessTipKeepsTheMass) {
  const auto with_mass = make_structure(rigid_bar({"structure.massless_tip=false"}));
  const auto without = make_structure(rigid_bar());
  EXPECT_EQ(without.mass.coeff(24, 24), 0.0);
  EXPECT_EQ(without.mass.coeff(24, 23), 0.0);
  EXPECT_NEAR(without.mass.sum(), with_mass.mass.sum(), 1e-12 * with_mass.mass.sum());
}

TEST(Analyse, RigidContactHoldsForAllPairs) {
  for (const auto& [trial, weight] :
       std::vector<std::pair<std::string, std::string>>{{"fourier", "fourier"},
                                                        {"bspline", "bspline"},
                                                        {"daubechies6", "daubechies6"},
                                                        {"haar", "fourier"},
                                                        {"daubechies6", "fourier"},
                                                        {"haar", "bspline"}}) {
    const Record record = analyse(rigid_bar({"time.trial=" + trial, "time.weight=" + weight,
                                             "analysis.stability=false", "analysis.phases=false"}));
    EXPECT_TRUE(record.converged) << trial << weight << record.status;
    // The discretisation error of 64 functions, below 1 % of the gap of 1 mm.
    EXPECT_LE(value_of<double>(record.summary, "max_penetration_m"), 1e-5) << trial << weight;
    EXPECT_EQ(value_of<std::string>(record.summary, "form"), "force");
    EXPECT_GE(value_of<double>(record.summary, "min_contact_force_N"), 0.0);
    // The mean force converges to 0.0502..0.0515 amplitudes (found independently); 64 functions are near.
    const auto force = record.response.numbers("contact_force_N");
    double mean = 0.0;
    for (const double one : force) mean += one / static_cast<double>(force.size());
    EXPECT_NEAR(mean / 250e3, 0.0515, 0.003) << trial << weight;
  }
}

TEST(Analyse, RigidContactIsTheLimitOfAStiffSpring) {
  Scene spring = rigid_bar();
  spring.contact.law = "linear";
  spring.contact.values["stiffness"] = 1e13;
  const Response stiff = weighted_residual_response(spring), rigid = weighted_residual_response(rigid_bar());
  ASSERT_TRUE(stiff.converged && rigid.converged);
  EXPECT_LT((stiff.displacement() - rigid.displacement()).cwiseAbs().maxCoeff(), 1e-3 * 1e-3);
}

}  // namespace
