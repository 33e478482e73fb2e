// Holds what the program writes to the closed form and to values found independently.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "curves.hpp"
#include "ll10_results.hpp"
#include "multiplier_strategies.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
namespace {

namespace fs = std::filesystem;
using Columns = std::vector<std::string>;

TEST(Ll10Paper, NotationsShowABoundaryOfThreePartsAndAnObstacleAtTheGap) {
  results().need({"fig01"});
  const Table table = results().read("fig01_notations.csv");
  const auto points = [&](const std::string& part, const char* column) {
    return table.where("part", part).numbers(column);
  };
  const auto x = points("Gamma_C", "x"), y = points("Gamma_C", "y"), over = points("obstacle", "x"),
             up = points("obstacle", "y");
  ASSERT_EQ(x.size(), over.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(std::hypot(x[i] - over[i], y[i] - up[i]), 0.16, 1e-6);
  EXPECT_GT(points("Gamma_D", "x").size(), 10u);
  EXPECT_EQ(x.front(), points("Gamma_F", "x").back());
}

TEST(Ll10Paper, BackboneHoldsItsFormulationsAndTheExactOneIsTheClosedForm) {
  results().need({"fig03"});
  const Table table = results().read("fig03_backbone.csv");
  EXPECT_EQ(table.columns(),
            (Columns{"formulation", "energy_ratio", "frequency_ratio", "rayleigh_frequency_ratio"}));
  EXPECT_TRUE(results().has("fig03_backbone.svg") && results().has("fig03_backbone.png"));
  for (const char* formulation : {"published", "consistent", "consistent_half_lumped", "exact"}) {
    const auto energy = table.where("formulation", formulation).numbers("energy_ratio");
    EXPECT_GE(*std::max_element(energy.begin(), energy.end()), 10.0 - 1e-9) << formulation;
  }
  const Table exact = table.where("formulation", "exact");
  const auto energy = exact.numbers("energy_ratio"), ratio = exact.numbers("frequency_ratio");
  for (std::size_t i = 2; i < energy.size(); ++i) {
    // gamma/gamma_lin = 8 V^2 T (T-2)(6-T) / (4 pi^2), V = 1/(2T-6), omega/omega_1 = 4/T.
    const double t = 4.0 / ratio[i], v = 1.0 / (2.0 * t - 6.0);
    EXPECT_NEAR(8.0 * v * v * t * (t - 2.0) * (6.0 - t) / (4.0 * std::numbers::pi * std::numbers::pi),
                energy[i], 1e-11 * energy[i]);
  }
}

TEST(Ll10Paper, ConsistentCurveIsNearTheExactOneAndThePublishedOneIsNot) {
  results().need({"fig03"});
  const Table table = results().read("fig03_backbone.csv");
  const auto last = [&](const std::string& formulation) {
    const Table rows = table.where("formulation", formulation);
    return std::pair{rows.numbers("energy_ratio").back(), rows.numbers("frequency_ratio").back()};
  };
  const auto scene = app::load_scene(fs::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010" / "rod.toml");
  const auto [energy, ratio] = last("consistent");
  EXPECT_NEAR(ratio, exact_mode(scene, energy).frequency_ratio(), 0.01 * ratio);
  const auto [published_energy, published] = last("published");
  EXPECT_LT(published, 0.96 * exact_mode(scene, published_energy).frequency_ratio());
}

TEST(Ll10Paper, MassMatrixOfThePaperIsThatOfTheConsistentCurve) {
  const auto scenes = fs::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010";
  const app::ModeStudy paper(app::load_scene(scenes / "rod.toml")),
      remedy(app::load_scene(scenes / "rod_half_lumped.toml"));
  // NUMBERS: 1297.5197 Hz and omega_2/omega_1 = 3.00617 for 20 consistent elements.
  EXPECT_NEAR(paper.linear_frequency(), 1297.5197, 1e-4);
  const auto quotient = [](const app::ModeStudy& study) {
    return std::sqrt(study.mode().model().omega_squared[1] / study.mode().model().omega_squared[0]);
  };
  EXPECT_NEAR(quotient(paper), 3.00617, 1e-5);
  EXPECT_NEAR(quotient(remedy), 3.0, 1e-4);
  results().need({"fig03"});
  const Table table = results().read("fig03_backbone.csv").where("formulation", "consistent");
  const auto energy = table.numbers("energy_ratio"), ratio = table.numbers("frequency_ratio");
  const auto curve = paper.backbone();
  const auto point = paper.at_energy(curve, 5.0);
  double nearest = 1.0;
  for (std::size_t i = 0; i < energy.size(); ++i)
    if (std::abs(energy[i] - 5.0) < 0.3)
      nearest = std::min(nearest, std::abs(ratio[i] - point.omega / paper.mode().linear_omega()));
  EXPECT_LT(nearest, 0.003);
}

TEST(Ll10Paper, VerdictsOnTheRodFollowTheFigures) {
  results().need({"fig03"});
  using enum report::Verdict;
  const auto verdict = [](const char* words) { return results().verdict("fig03_backbone", words); };
  EXPECT_EQ(verdict("1297.5 Hz"), agrees);
  EXPECT_TRUE(results().passes("fig03_backbone", "initial gap amplitude"));
  EXPECT_EQ(verdict("reaches unity"), agrees);
  EXPECT_EQ(verdict("hardening"), agrees);
  EXPECT_EQ(verdict("omega^2 = r"), differs);
  EXPECT_EQ(verdict("identically zero; hence"), differs);
  EXPECT_EQ(verdict("becomes $\\min r"), differs);
  EXPECT_EQ(verdict("Eq. (24c)"), misprint);
  EXPECT_TRUE(results().passes("fig03_backbone", "their work is identically zero"));
  EXPECT_TRUE(results().passes("fig03_backbone", "Two solvers give one mode"));
}

TEST(Ll10Paper, ContactOfTheRodItselfBeginsEarlierThanTheTextSays) {
  results().need({"fig03"});
  const auto statement = results().statement("fig03_backbone", "reaches unity");
  const auto beside = report::of_text(statement.readings, false);
  ASSERT_EQ(beside.size(), 2u);
  for (const auto& reading : beside) EXPECT_EQ(reading.verdict, report::Verdict::differs) << reading.name;
  EXPECT_EQ(beside[0].measured, "from 0.8106 on");  // 8/pi^2
}

TEST(Ll10Paper, WithMoreSamplesFiveHarmonicsMoveAsBeforeAndTheirForceGrows) {
  results().need({"fig03_sampling"});
  const Table table = results().read("fig03_sampling.csv");
  const auto harmonics = table.numbers("harmonics"), samples = table.numbers("samples"),
             frequency = table.numbers("frequency_ratio"), force = table.numbers("largest_force_N"),
             contact = table.numbers("contact_fraction");
  std::size_t first = table.rows();
  int compared = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (harmonics[row] != 5.0) continue;
    first = std::min(first, row);
    EXPECT_NEAR(frequency[row], frequency[first], 1e-14);
    EXPECT_NEAR(force[row] / force[first], samples[row] / samples[first], 1e-9);
    EXPECT_NEAR(contact[row], 1.0 / samples[row], 1e-15);
    ++compared;
  }
  EXPECT_EQ(compared, 4);
  EXPECT_EQ(results().verdict("fig03_sampling", "N significantly smaller than m"), report::Verdict::depends);
}

TEST(Ll10Paper, BothAlgorithmsAgreeAndTakeAsManySteps) {
  results().need({"algorithms"});
  using enum report::Verdict;
  EXPECT_EQ(results().verdict("algorithms", "similar results"), agrees);
  EXPECT_EQ(results().verdict("algorithms", "computationally more expensive"), ties);
  EXPECT_EQ(results().verdict("algorithms", "sufficiently small"), agrees);
  EXPECT_EQ(results().record("algorithms").slips.size(), 7u);
  EXPECT_EQ(results().verdict("algorithms", "improves convergence"), agrees);
  const Table table = results().read("algorithms.csv");
  const auto harmonics = table.numbers("harmonics"), energy = table.numbers("last_energy_ratio");
  for (std::size_t row = 0; row < table.rows(); ++row)
    EXPECT_EQ(energy[row] == 10.0, harmonics[row] < 3.0) << row;
}

TEST(MultiplierStrategies, MeasureConstraintsAsPowellDoes) {
  MultipliersOnly multipliers(2, 10.0);
  const std::vector<double> g{0.5, -0.2}, h{-0.1};
  const auto first = multipliers.update(g, h);
  EXPECT_DOUBLE_EQ(first.inequality_measure, 0.5);
  EXPECT_DOUBLE_EQ(first.equality_measure, 0.1);
  EXPECT_FALSE(first.converged());
  std::vector<double> force(2), tangent(2);
  multipliers.inequality_force(g, force, tangent);
  EXPECT_EQ(force, (std::vector<double>{5.0, 0.0}));
  EXPECT_EQ(tangent, (std::vector<double>{0.0, 0.0}));
  EXPECT_TRUE(multipliers.update(std::vector<double>{0.0, -0.2}, std::vector<double>{0.0}).converged());
  PenaltiesOnly penalties(2, 10.0);
  penalties.inequality_force(g, force, tangent);
  EXPECT_EQ(force, (std::vector<double>{5.0, 0.0}));
  EXPECT_EQ(tangent, (std::vector<double>{10.0, 0.0}));
  penalties.update(g, h);
  EXPECT_DOUBLE_EQ(penalties.equality_penalties()[0], 100.0);
}

TEST(Ll10Paper, AugmentedLagrangianAndCondensedSolverAgreeToSixDigits) {
  const app::ModeStudy study(
      app::load_scene(fs::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010" / "rod.toml"));
  const Agreement agreement = lagrangian_agreement(study, study.backbone(), {1.2, 1.8, 3.0, 5.0, 10.0});
  EXPECT_GE(agreement.points, 4);
  EXPECT_LT(agreement.largest, 1e-6);
}

TEST(Ll10Paper, MedianErrorShrinksWithTheHarmonics) {
  const auto distance = [](const std::string& harmonics) {
    const std::vector<std::string> overrides{"analysis.harmonics=" + harmonics,
                                             "analysis.samples=" + std::to_string(2 * std::stoi(harmonics)),
                                             "structure.elements=80"};
    const app::ModeStudy study(
        app::load_scene(fs::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010" / "rod.toml", overrides));
    return exact_distance(study, study.backbone()).median;
  };
  const double coarse = distance("5"), fine = distance("18");
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(Ll10Paper, MotionsLookAsDescribed) {
  results().need({"fig02", "fig04", "fig05"});
  using enum report::Verdict;
  EXPECT_EQ(results().verdict("fig04_phase_space", "velocity singularities"), agrees);
  EXPECT_TRUE(results().passes("fig04_phase_space", "elliptic trajectories"));
  EXPECT_TRUE(results().passes("fig05_space_time", "standing wave"));
  EXPECT_EQ(results().verdict("fig05_space_time", "over a fraction of the period"), depends);
  EXPECT_EQ(results().verdict("fig05_space_time", "traveling wave"), agrees);
  EXPECT_TRUE(results().passes("fig05_space_time", "no more algebraically related"));
  EXPECT_EQ(results().verdict("fig05_space_time", "simultaneous maximum"), agrees);
  EXPECT_TRUE(results().passes("fig05_space_time", "symmetry in time and space"));
  for (const char* stem : {"fig02_rod_sketch", "fig04_phase_space", "fig05_space_time"})
    for (const char* suffix : {".csv", ".svg", ".png"})
      EXPECT_TRUE(results().has(stem + std::string(suffix))) << stem;
  const Table table = results().read("fig05_space_time.csv");
  const auto exact = table.numbers("displacement_energy_1.8_exact");
  EXPECT_NEAR(*std::max_element(exact.begin(), exact.end()), 1.0, 0.3);
  EXPECT_EQ(table.rows(), 21u * 129u);
}

}  // namespace
}  // namespace wavebalance::ll10
