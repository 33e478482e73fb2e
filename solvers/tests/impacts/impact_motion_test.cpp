// Refusals of motions with impacts; a table of motions is in tests/impacts/impact_table.py.
#include "wavebalance/solvers/impacts/impact_motion.hpp"

#include "impacts/impact_parts.hpp"
#include "support/impact_scenes.hpp"
#include "support/refusal.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"
#include "wavebalance/solvers/problem/coexisting_motions.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ImpactScene, testing::impact_oscillator, testing::refusal;

TEST(ImpactMotionTest, RefusesMotionsThatPassTheObstacleOrArePulled) {
  const ImpactScene scene = impact_oscillator(0.05, 0.0, 0.8, 3.7);
  const ContactDynamics dynamics(scene.structure());
  const ExactProblem problem = scene.problem(dynamics);
  const ExactSolution none = impact_motion(problem, {});
  EXPECT_EQ(none.status, ExactStatus::penetrating);
  EXPECT_NEAR(detail::impact_solution(problem, {}).penetration, std::abs(problem.linear_motion(0, 1)), 1e-12);
  int refused = 0;
  for (int k = 0; k < 40; ++k) {
    const ExactSolution motion =
        impact_motion(over_periods(problem, 3), {{0, k / 40.0, 1.0}, {0, 0.5 + k / 40.0, 0.2}});
    if (motion.converged()) {
      const Eigen::MatrixXd u = motion.displacement(Eigen::VectorXd::LinSpaced(3001, 0.0, 1.0));
      EXPECT_LE(u.maxCoeff(), 1e-12);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(ImpactMotionTest, NamesWhatIsWrongWithItsInput) {
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  const ExactProblem good = scene.problem(dynamics);
  const auto words = [&](double restitution, double gap, double frequency, int contact) {
    const ExactProblem bad{dynamics, testing::Obstacle(gap, restitution), good.linear_motion, frequency};
    return refusal([&] { impact_motion(bad, {{contact, 0.1, 1.0}}); });
  };
  EXPECT_EQ(words(1.5, 1.0, 1.0, 0), "impact_motion: restitution is 1.5; it must be in 0..1");
  EXPECT_EQ(words(-0.1, 1.0, 1.0, 0), "impact_motion: restitution is -0.1; it must be in 0..1");
  EXPECT_EQ(words(nan, 1.0, 1.0, 0), "impact_motion: restitution is nan; it must be in 0..1");
  EXPECT_EQ(words(0.8, infinity, 1.0, 0), "impact_motion: a gap is not finite; all must be");
  EXPECT_EQ(words(0.8, 1.0, 0.0, 0), "impact_motion: frequency is 0; it must be positive and finite");
  EXPECT_EQ(words(0.8, 1.0, 1.0, 3), "impact_motion: contact is 3; it must be a contact of the structure");
}

TEST(ImpactMotionTest, RefusesContactsWithoutMassAndStructuralDamping) {
  ImpactScene scene = testing::two_masses_with_impacts(0.3, 0.7, 1.6);
  scene.mass(0, 0) = 0.0;
  scene.damping.setZero();
  const ContactDynamics massless(scene.structure());
  EXPECT_EQ(
      refusal([&] { impact_motion(scene.problem(massless), {}); }),
      "impact_motion: contact 0 has no mass, so that an impact there has no impulse; it must have mass");
  LinearStructure structural = impact_oscillator(0.1, 1.0, 0.8, 1.0).structure();
  structural.loss_factor = 0.1;
  const ContactDynamics damped(structural);
  EXPECT_NE(refusal([&] {
              impact_motion(impact_oscillator(0.1, 1.0, 0.8, 1.0).problem(damped), {});
            }).find("structural damping"),
            std::string::npos);
}

TEST(ImpactResponseTest, StopsWhereItsObserverSaysSo) {
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  ImpactResponseOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 2; };
  EXPECT_EQ(impact_response(scene.problem(dynamics), options).motion.status, ExactStatus::cancelled);
}

TEST(EventMotionsTest, StopWhereTheirObserverSaysSoAndRefuseOptionsOutOfRange) {
  const ImpactScene scene = impact_oscillator(0.1, 1.0, 0.8, 1.0);
  const ContactDynamics dynamics(scene.structure());
  MotionsOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 3; };
  EXPECT_EQ(event_motions(scene.problem(dynamics), options).status, MotionsStatus::cancelled);
  EXPECT_EQ(refusal([&] { event_motions(scene.problem(dynamics), {.random_starts = -1}); }),
            "MotionsOptions: random_starts is -1; it must be at least 0");
}

}  // namespace
}  // namespace wavebalance::solvers
