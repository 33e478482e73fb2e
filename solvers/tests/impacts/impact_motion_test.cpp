#include "wavebalance/solvers/impacts/impact_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "constants.hpp"
#include "support/impact_table.hpp"
#include "support/refusal.hpp"
#include "wavebalance/solvers/impacts/impact_stability.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ImpactScene, testing::impact_oscillator, testing::known_impacts, testing::KnownImpacts,
    testing::refusal;
using Complex = std::complex<double>;

// The first two digits of a table, from which Newton's method has its way to go.
std::vector<ImpactGuess> rough_start(const KnownImpacts& known) {
  std::vector<ImpactGuess> start;
  for (std::size_t i = 0; i < known.instants.size(); ++i)
    start.push_back({known.contacts[i], std::round(100.0 * known.instants[i]) / 100.0 / known.periods,
                     std::round(100.0 * known.impulses[i]) / 100.0});
  return start;
}

ImpactMotion motion_of_table(const KnownImpacts& known, const ContactDynamics& dynamics) {
  return impact_motion(known.scene.problem(dynamics).over_periods(known.periods), rough_start(known));
}

TEST(ImpactMotionTest, HasTheImpactsOfTheTable) {
  for (const KnownImpacts& known : known_impacts()) {
    const ContactDynamics dynamics(known.scene.structure());
    const ImpactMotion motion = motion_of_table(known, dynamics);
    ASSERT_EQ(motion.status, ImpactStatus::converged) << to_string(motion.status);
    ASSERT_EQ(motion.impacts.size(), known.instants.size());
    for (std::size_t i = 0; i < known.instants.size(); ++i) {
      EXPECT_NEAR(motion.impacts[i].time * known.periods, known.instants[i], 1e-9);
      EXPECT_NEAR(motion.impacts[i].velocity_before, known.velocities[i], 1e-9);
      EXPECT_NEAR(motion.impacts[i].impulse, known.impulses[i], 1e-9);
      EXPECT_EQ(motion.impacts[i].contact, known.contacts[i]);
    }
  }
}

TEST(ImpactMotionTest, HasTheMultipliersOfTheTable) {
  for (const KnownImpacts& known : known_impacts()) {
    const ContactDynamics dynamics(known.scene.structure());
    const Eigen::VectorXcd found = impact_multipliers(motion_of_table(known, dynamics));
    for (const Complex expected : known.multipliers) {
      const double nearest = (found.array() - expected).abs().minCoeff();
      EXPECT_LE(nearest, 1e-8 * std::max(1.0, std::abs(expected)));
    }
  }
}

}  // namespace
}  // namespace wavebalance::solvers
