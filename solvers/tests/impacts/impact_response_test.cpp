#include "wavebalance/solvers/impacts/impact_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "constants.hpp"
#include "support/impact_oracle.hpp"
#include "support/impact_table.hpp"
#include "support/refusal.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ImpactOracle, testing::ImpactScene, testing::impact_oscillator, testing::lumped_bar;

TEST(ImpactResponseTest, SettlesToAStableMotionOfTheTable) {
  for (const auto& known : testing::known_impacts()) {
    if (std::abs(known.multipliers.front()) > 1.0) continue;
    const ContactDynamics dynamics(known.scene.structure());
    const ImpactResponse found = impact_response(known.scene.problem(dynamics));
    ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
    EXPECT_EQ(found.unstable, 0);
    // Of several stable motions it is one; a load period later it is another of the table.
    if (found.load_periods != known.periods || found.motion.impacts.size() != known.impulses.size()) continue;
    for (const Impact& impact : found.motion.impacts) {
      double nearest = infinity;
      for (std::size_t i = 0; i < known.impulses.size(); ++i)
        if (known.contacts[i] == impact.contact)
          nearest = std::min(nearest, std::abs(impact.impulse - known.impulses[i]));
      EXPECT_LE(nearest, 1e-9);
    }
  }
}

TEST(ImpactResponseTest, NamesChatteringWithItsEnd) {
  // A static load presses the oscillator against its stop, against which it comes to rest within a period.
  const ImpactScene scene = impact_oscillator(0.1, 0.0, 0.5, 0.2);
  const ContactDynamics dynamics(scene.structure());
  PhasesProblem problem = scene.problem(dynamics);
  const ImpactResponse found = impact_response(problem);
  EXPECT_TRUE(found.lasts());
  ASSERT_EQ(found.chattering_contact, 0);
  // The instants of impacts in time end where the geometric series of the last three does.
  const ImpactOracle oracle(scene, 20000);
  const double period = oracle.load_period(), end = found.chattering_end;
  double lowest = 0.0;  // of 64 instants, where the product begins
  for (int k = 0; k < 64; ++k)
    if (oracle.free_state(k * period / 64.0)[0] < oracle.free_state(lowest * period)[0]) lowest = k / 64.0;
  std::vector<ImpactOracle::Event> events;
  oracle.advance(oracle.free_state(lowest * period), lowest * period, (end - 1e-4) * period, events);
  ASSERT_GE(events.size(), 5u);
  const double a = events[events.size() - 3].time, b = events[events.size() - 2].time, c = events.back().time;
  EXPECT_NEAR((c - (c - b) * (c - b) / ((c - b) - (b - a))) / period, end, 1e-5);
}

TEST(ImpactResponseTest, FindsTheMotionWithoutImpacts) {
  const ImpactScene scene = impact_oscillator(0.1, 10.5, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  const ImpactResponse found = impact_response(scene.problem(dynamics));
  EXPECT_TRUE(found.motion.converged());
  EXPECT_TRUE(found.motion.impacts.empty());
  EXPECT_EQ(found.unstable, 0);
}

TEST(ImpactResponseTest, StopsWhereItsObserverSaysSo) {
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  ImpactResponseOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 2; };
  EXPECT_EQ(impact_response(scene.problem(dynamics), options).motion.status, PhasesStatus::cancelled);
}

}  // namespace
}  // namespace wavebalance::solvers
