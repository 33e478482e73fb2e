// Exact curves by the map of the flow against curves by phases and event-driven integrations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "campaign.hpp"
#include "support/friction_motions.hpp"
#include "support/oracle_check.hpp"
#include "support/oscillator.hpp"
#include "support/phase_cases.hpp"
#include "support/random_friction.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionMotion, testing::FrictionScene;
using Type = SpecialPointType;

// From the motion of a scene up to another frequency.
ExactCurve curve_of(FrictionMotion& first, double to) {
  ExactCurveOptions options;
  options.from = first.scene.frequency();
  options.to = to;
  return exact_curve({first.problem, first.scene.contact_laws(), first.dynamics, SweepParameter::frequency},
                     first.phases.motion, options);
}

void expect_events(const ExactCurve& curve, const std::vector<std::pair<Type, double>>& expected,
                   double tolerance) {
  EXPECT_EQ(to_string(curve.status), "reached_end");
  ASSERT_EQ(curve.events.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(to_string(curve.events[i].type), to_string(expected[i].first));
    EXPECT_NEAR(curve.events[i].value, expected[i].second, tolerance * expected[i].second);
  }
}

// Curves by phases share the poles with the flow, and no equation.
TEST(MapCurve, OfAnElasticStopHasTheSpecialPointsOfTheCurveByPhases) {
  const LinearStructure structure = testing::unit_oscillator(0.05, 0.15);
  const ContactLaws laws = testing::LinearContact{4.0, 1.0};
  const ContactDynamics dynamics(structure);
  CondensedProblem problem(testing::fourier_pair(63, 256), structure, testing::cosine_load());
  problem.set_frequency(0.1);
  const PeriodicResponse response = forced_response(problem, laws, {});
  const PhaseFamily family(problem, laws, dynamics, SweepParameter::frequency);
  ExactCurveOptions options;
  options.from = 0.1;
  options.to = 0.35;
  const auto from = [&](auto* solve) {
    return exact_curve(family, response_phases(problem, laws, response, dynamics, {}, solve).motion, options);
  };
  std::vector<std::pair<Type, double>> expected;
  for (const ExactEvent& event : from(contact_phases).events) expected.emplace_back(event.type, event.value);
  EXPECT_EQ(expected.size(), 4u);
  const ExactCurve curve = from(flow_motion);
  expect_events(curve, expected, 1e-10);
  int unstable = 0;
  for (const ExactPoint& point : curve.points) unstable += point.unstable;
  EXPECT_GE(unstable, 3);
}

TEST(MapCurve, IsCancelledAndKeepsItsPoints) {
  FrictionMotion first(testing::slider_on_oscillator(0.6, 3.0, 1.0));
  ExactCurveOptions options;
  options.from = first.scene.frequency();
  options.to = 0.4;
  options.observer = [](const Progress& progress) { return progress.step < 5; };
  const ExactCurve curve =
      exact_curve({first.problem, first.scene.contact_laws(), first.dynamics, SweepParameter::frequency},
                  first.phases.motion, options);
  EXPECT_EQ(to_string(curve.status), "cancelled");
  EXPECT_EQ(curve.points.size(), 5u);
}

struct CurveCampaign {
  int curves = 0, whole = 0, points = 0;
  double worst = 0.0, multipliers = 0.0;
};

// Every fifteenth point of curves of friction beside stops.
void follow(const FrictionScene& scene, CurveCampaign& campaign) {
  FrictionMotion first(scene);
  if (first.phases.motion.parts == nullptr) return;
  const ExactCurve curve = curve_of(first, 1.03 * scene.frequency());
  ++campaign.curves;
  campaign.whole += curve.status == SweepStatus::reached_end;
  for (std::size_t i = 0; i < curve.points.size(); i += 15) {
    FrictionScene there = scene;
    there.omega = 2.0 * std::numbers::pi * curve.points[i].value;
    first.problem.set_frequency(curve.points[i].value);
    const testing::OracleCheck found = testing::check(there, first.problem, curve.points[i].motion);
    campaign.worst = std::max(campaign.worst, found.change);
    const auto& friction = curve.points[i].motion.friction;
    const bool rests = std::any_of(friction.begin(), friction.end(),
                                   [](const FrictionAlong& along) { return along.always_sticks(); });
    // A slider at rest has a multiplier of 1 in the oracle alone.
    if (!rests) campaign.multipliers = std::max(campaign.multipliers, found.multipliers);
    ++campaign.points;
  }
}

TEST(RandomMapCurves, HavePointsThatComeBackAfterAPeriodOfTheEventDrivenMotion) {
  std::mt19937 generator(1);
  CurveCampaign campaign;
  for (int i = 0; i < campaign_seeds(1, 40); ++i) follow(testing::random_mixture(generator), campaign);
  std::printf("%d curves, %d to their ends, %d points, worst %.1e, multipliers %.1e\n", campaign.curves,
              campaign.whole, campaign.points, campaign.worst, campaign.multipliers);
  EXPECT_GE(campaign.whole, int(0.97 * campaign.curves));
  EXPECT_LE(campaign.worst, 1e-8);
  EXPECT_LE(campaign.multipliers, 1e-7);
}

}  // namespace
}  // namespace wavebalance::solvers
