#include <gtest/gtest.h>

#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance::app;
using wavebalance::solvers::ModeStatus;

/// The blade's mode as its scene has it, reduced once for all tests.
const ModeStudy& blade_study() {
  static const ModeStudy study(
      load_scene(std::filesystem::path(WAVEBALANCE_SCENES) / "laxalde_legrand_2010" / "blade_mode.toml"));
  return study;
}

const Backbone& blade_backbone() {
  static const Backbone backbone = blade_study().backbone();
  return backbone;
}

TEST(BladeMode, ReducedModelKeepsTheFrequencies) {
  EXPECT_EQ(blade_study().model().unknowns, 3936);
  EXPECT_EQ(blade_study().model().size(), 112);
  EXPECT_EQ(blade_study().model().contacts(), 24);
  // Found independently; the reduction is within 4e-4.
  const double expected[] = {570.0, 1662.4, 2206.2, 3781.2, 4655.5};
  for (int mode = 0; mode < 5; ++mode)
    EXPECT_NEAR(std::sqrt(blade_study().mode().model().omega_squared[mode]) / (2.0 * std::acos(-1.0)),
                expected[mode], 5e-4 * expected[mode]);
}

TEST(BladeMode, BackboneIsThatFoundIndependently) {
  const double expected[][2] = {{1.2, 1.0069}, {2.0, 1.0377}, {3.0, 1.0808}, {7.0, 1.1931}};
  EXPECT_TRUE(blade_backbone().converged()) << blade_backbone().status();
  for (const auto& [energy, ratio] : expected) {
    const auto point = blade_study().at_energy(blade_backbone(), energy);
    ASSERT_EQ(point.status, ModeStatus::converged) << energy;
    EXPECT_NEAR(point.omega / blade_study().mode().linear_omega(), ratio, 0.003) << energy;
    EXPECT_LT(blade_study().residual(point), 1e-9);
    EXPECT_LT(point.virial_residual, 1e-12);
    EXPECT_GE(point.min_force, 0.0);
  }
}

TEST(BladeMode, LeadingEdgeTouchesFirstTrailingEdgeHalfAPeriodLater) {
  const auto point = blade_study().at_energy(blade_backbone(), 4.7);
  ASSERT_EQ(point.status, ModeStatus::converged);
  const int half = static_cast<int>(point.force.cols()) / 2;
  EXPECT_GT(point.force.col(0).head(2).maxCoeff(), 0.0);  // the leading edge's pair
  EXPECT_EQ(point.force.col(0).tail(2).maxCoeff(), 0.0);
  EXPECT_GT(point.force.col(half).tail(2).maxCoeff(), 0.0);  // the trailing edge's
  EXPECT_EQ(point.force.col(half).head(2).maxCoeff(), 0.0);
}

}  // namespace
