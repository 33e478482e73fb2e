#include "wavebalance/solvers/problem/coexisting_motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/impact_table.hpp"
#include "support/refusal.hpp"

namespace wavebalance::solvers {
namespace {

using testing::impact_oscillator, testing::ImpactScene;

// Whether a motion has the impulses of one of the table.
bool has_impulses_of(const CoexistingMotion& found, const testing::KnownImpacts& known) {
  const auto& impacts = found.motion.impacts;
  if (found.periods != known.periods || impacts.size() != known.impulses.size()) return false;
  return std::ranges::all_of(impacts, [&](const Impact& impact) {
    return std::ranges::any_of(known.impulses,
                               [&](double impulse) { return std::abs(impact.impulse - impulse) <= 1e-8; });
  });
}

TEST(EventMotionsTest, FindTheStableMotionOfTwoPeriodsThatTheTableHas) {
  const ImpactScene scene = impact_oscillator(0.05, 0.0, 0.8, 3.7);
  const ContactDynamics dynamics(scene.structure());
  const CoexistingMotions found = event_motions(scene.problem(dynamics));
  ASSERT_EQ(found.status, MotionsStatus::converged) << to_string(found.status);
  int seen = 0, arrivals = 0;
  for (const testing::KnownImpacts& known : testing::known_impacts()) {
    if (known.scene.omega != 3.7 || std::abs(known.multipliers.front()) > 1.0) continue;
    seen += std::ranges::any_of(found.motions, [&](const CoexistingMotion& one) {
      return one.found_by != MotionSource::newton && one.stability.unstable == 0 &&
             has_impulses_of(one, known);
    });
  }
  // The table has it twice, a period of the load apart.
  EXPECT_EQ(seen, 2);
  for (const CoexistingMotion& one : found.motions) arrivals += one.arrivals;
  EXPECT_EQ(arrivals + found.none, found.starts);
  EXPECT_EQ(found.starts, 24);
}

TEST(EventMotionsTest, AreEachThereOnceAlsoWherePeriodsOfTheLoadLieBetween) {
  const ImpactScene scene = impact_oscillator(0.05, 0.0, 0.8, 3.7);
  const ContactDynamics dynamics(scene.structure());
  const CoexistingMotions found = event_motions(scene.problem(dynamics));
  for (std::size_t i = 0; i < found.motions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const PhaseMotion &a = found.motions[i].motion, &b = found.motions[j].motion;
      const bool alike = a.impacts.size() == b.impacts.size() &&
                         std::abs(a.frequency() - b.frequency()) < 1e-12 &&
                         std::abs(a.energy_lost() - b.energy_lost()) < 1e-9 * (1.0 + a.energy_lost());
      EXPECT_FALSE(alike) << i << " and " << j;
    }
}

TEST(EventMotionsTest, AreTheSameForTheSameSeedAndStableWhereStartsSettle) {
  const ImpactScene scene = testing::two_masses_with_impacts(0.3, 0.7, 1.6);
  const ContactDynamics dynamics(scene.structure());
  const CoexistingMotions one = event_motions(scene.problem(dynamics), {.random_starts = 6}),
                          other = event_motions(scene.problem(dynamics), {.random_starts = 6});
  ASSERT_EQ(one.motions.size(), other.motions.size());
  for (std::size_t i = 0; i < one.motions.size(); ++i) {
    EXPECT_EQ(one.motions[i].arrivals, other.motions[i].arrivals);
    EXPECT_TRUE(one.motions[i].motion.converged());
    if (one.motions[i].found_by != MotionSource::newton) {
      EXPECT_EQ(one.motions[i].stability.unstable, 0);
    }
  }
}

TEST(EventMotionsTest, StopWhereTheirObserverSaysSoAndRefuseOptionsOutOfRange) {
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  MotionsOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 3; };
  EXPECT_EQ(event_motions(scene.problem(dynamics), options).status, MotionsStatus::cancelled);
  EXPECT_EQ(testing::refusal([&] { event_motions(scene.problem(dynamics), {.random_starts = -1}); }),
            "MotionsOptions: random_starts is -1; it must be at least 0");
}

}  // namespace
}  // namespace wavebalance::solvers
