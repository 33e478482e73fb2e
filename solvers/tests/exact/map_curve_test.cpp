// Exact curves by the map of the flow against curves by collocation and closed forms.

#include "support/collocation_cases.hpp"
#include "support/friction_motions.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionMotion;
using Type = SpecialPointType;

void expect_events(const ExactCurve& curve, const std::vector<std::pair<Type, double>>& expected,
                   double tolerance) {
  EXPECT_EQ(to_string(curve.status), "reached_end");
  ASSERT_EQ(curve.events.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(to_string(curve.events[i].type), to_string(expected[i].first));
    EXPECT_NEAR(curve.events[i].value, expected[i].second, tolerance * expected[i].second);
  }
}

// Curves by collocation share the poles with the flow, and no equation.
TEST(MapCurve, OfAnElasticStopHasTheSpecialPointsOfTheCurveByCollocation) {
  const LinearStructure structure = testing::unit_oscillator(0.05, 0.15);
  const ContactLaws laws = testing::LinearContact{4.0, 1.0};
  const ContactDynamics dynamics(structure);
  CondensedProblem problem = testing::fourier_problem(structure, 63, 256, 0.1);
  const PeriodicResponse response = forced_response(problem, laws, {});
  const ProblemFamily family(problem, laws, dynamics, SweepParameter::frequency);
  ExactCurveOptions options{.from = 0.1, .to = 0.35};
  const auto from = [&](auto* solve) {
    return exact_curve(family, exact_near_response(problem, laws, response, dynamics, {}, solve).motion,
                       options);
  };
  std::vector<std::pair<Type, double>> expected;
  for (const ExactEvent& event : from(collocation_motion).events)
    expected.emplace_back(event.type, event.value);
  EXPECT_EQ(expected.size(), 4u);
  const ExactCurve curve = from(flow_motion);
  expect_events(curve, expected, 1e-10);
  int unstable = 0;
  for (const ExactPoint& point : curve.points) unstable += point.unstable;
  EXPECT_GE(unstable, 3);
}

TEST(MapCurve, IsCancelledAndKeepsItsPoints) {
  FrictionMotion first(testing::slider_on_oscillator(0.6, 3.0, 1.0));
  ExactCurveOptions options{.from = first.scene.frequency(), .to = 0.4};
  options.observer = [](const Progress& progress) { return progress.step < 5; };
  const ExactCurve curve =
      exact_curve({first.problem, first.scene.contact_laws(), first.dynamics, SweepParameter::frequency},
                  first.exact.motion, options);
  EXPECT_EQ(to_string(curve.status), "cancelled");
  EXPECT_EQ(curve.points.size(), 5u);
}

}  // namespace
}  // namespace wavebalance::solvers
