// Holds what the program writes to the closed form and to values found independently.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "curves.hpp"
#include "ll10_results.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::ll10 {
namespace {

namespace fs = std::filesystem;
using Columns = std::vector<std::string>;

TEST(Ll10Paper, BackboneHoldsThreeFormulationsAndTheExactOneIsTheClosedForm) {
  results().need({"fig03"});
  const Table table = results().read("fig03_backbone.csv");
  EXPECT_EQ(table.columns(),
            (Columns{"formulation", "energy_ratio", "frequency_ratio", "rayleigh_frequency_ratio"}));
  EXPECT_TRUE(results().has("fig03_backbone.svg") && results().has("fig03_backbone.png"));
  for (const char* formulation : {"published", "consistent", "exact"}) {
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

TEST(Ll10Paper, VerdictsFollowTheFigures) {
  results().need({"fig03"});
  EXPECT_TRUE(results().passes("fig03_backbone", "1297.5 Hz"));
  EXPECT_TRUE(results().passes("fig03_backbone", "hardening"));
  EXPECT_TRUE(results().passes("fig03_backbone", "identically zero"));
  EXPECT_FALSE(results().passes("fig03_backbone", "reaches unity"));
  EXPECT_FALSE(results().passes("fig03_backbone", "ω² = r"));
  EXPECT_FALSE(results().passes("fig03_backbone", "Eq. (24c)"));
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
  EXPECT_TRUE(results().passes("fig04_phase_space", "elliptic trajectories"));
  EXPECT_TRUE(results().passes("fig05_space_time", "standing wave"));
  EXPECT_TRUE(results().passes("fig05_space_time", "traveling wave"));
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
