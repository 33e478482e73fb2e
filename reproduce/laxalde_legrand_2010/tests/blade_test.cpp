// Holds what the program writes of the blade to values found independently.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "blade.hpp"
#include "ll10_results.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::ll10 {
namespace {

namespace fs = std::filesystem;

/// A point of the backbone that an independent program found for this blade (N = 5, m = 20).
struct ListedPoint {
  double energy_ratio, frequency_ratio;
};
constexpr ListedPoint listed_points[] = {{1.2, 1.0069}, {2.0, 1.0377}, {3.0, 1.0808}, {7.0, 1.1931}};

/// Frequency ratio of a formulation at an energy ratio, linear between its rows.
double at(const Table& table, const std::string& formulation, double energy_ratio,
          const std::string& column = "frequency_ratio") {
  const Table rows = table.where("formulation", formulation);
  const auto energy = rows.numbers("energy_ratio"), value = rows.numbers(column);
  for (std::size_t i = 1; i < energy.size(); ++i)
    if (energy[i - 1] <= energy_ratio && energy_ratio <= energy[i])
      return value[i - 1] +
             (value[i] - value[i - 1]) * (energy_ratio - energy[i - 1]) / (energy[i] - energy[i - 1]);
  throw std::runtime_error("no rows enclose the energy");
}

TEST(Ll10Blade, ModelIsReducedAsThePaperSaysAndItsNodesAreListed) {
  results().need({"fig06"});
  EXPECT_TRUE(results().passes("fig06_blade", "Craig-Bampton procedure"));
  const Table table = results().read("fig06_blade.csv");
  EXPECT_EQ(table.rows(), 24u);
  for (const double z : table.numbers("z_m")) EXPECT_EQ(z, 0.091);
  EXPECT_LT(table.numbers("x_m").front(), table.numbers("x_m").back());
  EXPECT_TRUE(results().has("fig06_blade.svg") && results().has("fig06_blade.png"));
}

TEST(Ll10Blade, BackboneIsTheListedOneAndThePublishedFormulaFallsShortOfIt) {
  results().need({"fig07"});
  const Table table = results().read("fig07_blade_backbone.csv");
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"formulation", "energy_ratio", "frequency_ratio",
                                                       "rayleigh_frequency_ratio"}));
  for (const auto& listed : listed_points)
    EXPECT_NEAR(at(table, "consistent", listed.energy_ratio), listed.frequency_ratio, 0.003);
  EXPECT_GT(table.where("formulation", "consistent").numbers("energy_ratio").back(), 10.4);
  EXPECT_GT(table.where("formulation", "published").numbers("energy_ratio").back(), 7.0);
  EXPECT_LT(at(table, "published", 7.0), 1.13);
  EXPECT_NEAR(at(table, "published", 7.0), at(table, "consistent", 7.0, "rayleigh_frequency_ratio"), 0.03);
}

// The printed equations are not followed to the end of the axis.
TEST(Ll10Blade, TheEndOfThePublishedCurveIsMarked) {
  results().need({"fig07"});
  EXPECT_NE(app::read_file(results().folder() / "fig07_blade_backbone.figure.js").find("not found beyond"),
            std::string::npos);
}

TEST(Ll10Blade, VerdictsOnTheBladeFollowTheFigures) {
  results().need({"fig07", "fig08"});
  using enum report::Verdict;
  const auto verdict = [](const char* words) { return results().verdict("fig07_blade_backbone", words); };
  EXPECT_EQ(verdict("increase of the natural frequency"), agrees);
  EXPECT_EQ(verdict("leading and trailing"), partly);
  for (const char* stem : {"fig07_blade_backbone", "fig08_blade_shapes"})
    for (const auto& statement : results().record(stem).statements)
      EXPECT_EQ(statement.apart, "on our blade") << statement.quote;
  EXPECT_TRUE(results().passes("fig07_blade_backbone", "Fig. 7 depicts"));
  EXPECT_TRUE(results().passes("fig07_blade_backbone", "for the blade as for the rod"));
  EXPECT_EQ(results().verdict("fig08_blade_shapes", "torsion effects"), agrees);
  EXPECT_EQ(results().verdict("fig08_blade_shapes", "Sensitivity of mode shapes"), agrees);
}

TEST(Ll10Blade, ShapesTwistMoreWithEnergyAndTheirMotionsAreWritten) {
  results().need({"fig08"});
  const Table table = results().read("fig08_blade_shapes.csv");
  ASSERT_EQ(table.rows(), 3u * 2u * 24u);
  const auto energy = table.numbers("energy_ratio"), time = table.numbers("time_fraction"),
             u = table.numbers("u_z_over_gap");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    EXPECT_LE(u[row], 1.0 + 1e-9) << row;
    if (energy[row] < 1.0) {
      EXPECT_LT(u[row], 1.0) << row;
    }
  }
  // The leading edge touches at t = 0, the trailing edge at T/2.
  const auto touches = [&](double ratio, double fraction, bool leading) {
    double largest = -1.0;
    for (std::size_t row = 0; row < table.rows(); ++row)
      if (energy[row] == ratio && time[row] == fraction && (row % 24 < 12) == leading)
        largest = std::max(largest, u[row]);
    return largest > 1.0 - 1e-9;
  };
  for (const double ratio : {4.7, 10.4}) {
    EXPECT_TRUE(touches(ratio, 0.0, true));
    EXPECT_TRUE(touches(ratio, 0.5, false));
    EXPECT_FALSE(touches(ratio, 0.0, false));
    EXPECT_FALSE(touches(ratio, 0.5, true));
  }
  for (const char* file :
       {"fig08_energy_0.8.pvd", "fig08_energy_4.7.pvd", "fig08_energy_10.4.pvd", "fig08_energy_10.4_15.vtu"})
    EXPECT_TRUE(results().has(file)) << file;
}

TEST(Ll10Blade, EveryPointBalancesItsForces) {
  const std::vector<std::string> overrides{"analysis.points=40"};
  const app::ModeStudy study(
      app::load_scene(fs::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010" / "blade_mode.toml", overrides));
  const auto curve = study.backbone();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (!curve.points[i].accepted()) continue;
    EXPECT_LT(curve.points[i].virial_residual, 1e-12) << i;  // omega^2 = r + <force> gap / m
    EXPECT_LT(curve.residuals[i], 1e-9) << i;
    EXPECT_GE(curve.points[i].min_force, 0.0) << i;
  }
}

}  // namespace
}  // namespace wavebalance::ll10
