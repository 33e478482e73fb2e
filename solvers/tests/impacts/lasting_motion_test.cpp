// Contacts that stay closed after impacts without rebound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "constants.hpp"
#include "flow/flow_start.hpp"
#include "linalg/dense.hpp"
#include "phases/phase_motion_parts.hpp"
#include "support/impact_scenes.hpp"
#include "wavebalance/solvers/flow/settled_motion.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::impact_oscillator, testing::ImpactScene, testing::lumped_bar, testing::Obstacle;

// x'' + 0.1 x' + x = cos w t from x = gap, x' = 0 on, by small steps of Runge and Kutta, until x = gap again.
struct Arrival {
  double time, velocity;
};
Arrival flight_of_oscillator(double damping, double gap, double omega, double from) {
  constexpr double step = 2e-4;
  double t = from, x = gap, v = 0.0;
  const auto a = [&](double at, double u, double w) { return std::cos(omega * at) - damping * w - u; };
  const auto advance = [&](double h) {
    const double k1 = v, l1 = a(t, x, v), k2 = v + 0.5 * h * l1, l2 = a(t + 0.5 * h, x + 0.5 * h * k1, k2),
                 k3 = v + 0.5 * h * l2, l3 = a(t + 0.5 * h, x + 0.5 * h * k2, k3), k4 = v + h * l3,
                 l4 = a(t + h, x + h * k3, k4);
    x += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    v += h * (l1 + 2.0 * l2 + 2.0 * l3 + l4) / 6.0;
    t += h;
  };
  for (int k = 0; k < 20; ++k) advance(step);
  while (x < gap) advance(step);
  for (int k = 0; k < 5; ++k) advance((gap - x) / v);
  return {t, v};
}

TEST(LastingContactTest, OfAnOscillatorOpensWhereTheLoadNoLongerPressesAndClosesWhereItComesBack) {
  for (const double gap : {0.0, 0.3}) {
    constexpr double omega = 0.5, damping = 0.1;
    const ImpactScene scene = impact_oscillator(damping, gap, 0.0, omega);
    const ContactDynamics dynamics(scene.structure());
    const ImpactResponse found = impact_response(scene.problem(dynamics));
    ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
    ASSERT_EQ(found.motion.phases.size(), 1u);
    const ContactPhase& closed = found.motion.phases.front();
    const double opens = std::acos(gap) / two_pi;  // cos w t = gap
    EXPECT_NEAR(closed.end - 1.0, opens, 1e-12);
    const Arrival back = flight_of_oscillator(damping, gap, omega, opens * two_pi / omega);
    const Impact& first = found.motion.impacts.front();
    EXPECT_NEAR(first.time, back.time * omega / two_pi, 1e-9);
    EXPECT_NEAR(first.velocity_before, back.velocity, 1e-9);
    EXPECT_EQ(found.unstable, 0);
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(997, 0.0, 0.998);
    const Eigen::MatrixXd u = found.motion.displacement(times), force = found.motion.force(times);
    EXPECT_LE(u.maxCoeff() - gap, 1e-12);
    EXPECT_GE(force.minCoeff(), 0.0);
    for (Eigen::Index k = 0; k < times.size(); ++k) {
      const bool inside = times[k] > closed.begin || times[k] < closed.end - 1.0;
      if (inside) {
        EXPECT_NEAR(u(0, k), gap, 1e-12);
        EXPECT_NEAR(force(0, k), std::cos(two_pi * times[k]) - gap, 1e-11);
      }
    }
  }
}

// Harmonics of the displacement are those of load and contact force through the compliance.
TEST(LastingContactTest, OfABarHasForcesThatMakeItsMotion) {
  constexpr int points = 1 << 16;
  const ImpactScene scene = lumped_bar(10, 0.0, 0.02, 0.5, 0.0, 0.7);
  const ContactDynamics dynamics(scene.structure());
  const PhaseMotion motion = impact_response(scene.problem(dynamics)).motion;
  ASSERT_TRUE(motion.converged()) << to_string(motion.status);
  ASSERT_EQ(motion.phases.size(), 2u);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  const Eigen::MatrixXd u = motion.displacement(times);
  EXPECT_LE(u.maxCoeff(), 0.5 + 1e-11);
  const Eigen::MatrixXcd force = motion.force_harmonics(6);
  for (int n = 0; n < 6; ++n) {
    std::complex<double> harmonic = 0.0;
    for (int k = 0; k < points; ++k)
      harmonic += u(0, k) * std::polar((n == 0 ? 1.0 : 2.0) / points, -two_pi * n * times[k]);
    const std::complex<double> s(0.0, n * scene.omega);
    const Eigen::MatrixXcd impedance = s * s * scene.mass.cast<std::complex<double>>() +
                                       s * scene.damping.cast<std::complex<double>>() +
                                       scene.stiffness.cast<std::complex<double>>();
    const Eigen::VectorXcd load = (scene.load * (n == 1 ? 1.0 : 0.0)).cast<std::complex<double>>() -
                                  scene.contacts.transpose() * force.col(n);
    const Eigen::VectorXcd all = detail::Lu<std::complex<double>>(impedance).solve(load);
    // The corner at the impact leaves an error of the sum of 1 / points^2.
    EXPECT_NEAR(std::abs((scene.contacts * all)(0) - harmonic), 0.0, 1e-7) << n;
  }
}

TEST(LastingContactTest, HasTheMultipliersOfDifferencesOfItsMotions) {
  const ImpactScene scene = lumped_bar(6, 0.0, 0.02, 0.5, 0.0, 0.7);
  const ContactDynamics dynamics(scene.structure());
  const ImpactResponse found = impact_response(scene.problem(dynamics));
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  const PeriodStart start = *found.motion.parts->start;
  ContactFlow flow(detail::begun_at({dynamics, ContactLaws(Obstacle{0.5, 0.0}),
                                     scene.problem(dynamics).contact_free, scene.problem(dynamics).frequency},
                                    start.begin),
                   {.tolerance = 1e-12});
  constexpr double change = 1e-6;
  const auto after = [&](Eigen::VectorXd state) {
    flow.start(state, start.contacts);
    EXPECT_EQ(flow.advance_period(), FlowStatus::converged);
    return flow.state();
  };
  Eigen::MatrixXd monodromy(start.state.size(), start.state.size());
  for (Eigen::Index i = 0; i < start.state.size(); ++i) {
    const Eigen::VectorXd step = change * Eigen::VectorXd::Unit(start.state.size(), i);
    monodromy.col(i) = (after(start.state + step) - after(start.state - step)) / (2.0 * change);
  }
  Eigen::VectorXcd expected = detail::eigenvalues(monodromy);
  std::ranges::stable_sort(
      expected, [](std::complex<double> a, std::complex<double> b) { return std::abs(a) > std::abs(b); });
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_NEAR(std::abs(expected[i]), std::abs(found.multipliers[i]), 1e-6);
}

TEST(LastingContactTest, OfABarTendsToALimitAsItsElementsAreRefined) {
  double last = 0.0, change = infinity;
  for (const int elements : {10, 20, 40}) {
    const ImpactScene scene = lumped_bar(elements, 0.0, 0.02, 0.5, 0.0, 0.7);
    const ContactDynamics dynamics(scene.structure());
    const PhaseMotion motion = impact_response(scene.problem(dynamics)).motion;
    ASSERT_TRUE(motion.converged()) << elements;
    const double mean = motion.force_harmonics(1)(0, 0).real();
    if (last != 0.0) {
      EXPECT_LT(std::abs(mean - last), 0.6 * change) << elements;
      change = std::abs(mean - last);
    }
    last = mean;
  }
}

// The map of the flow has the motion of the equations of impacts, between which no contact has a force.
TEST(SettledMotionTest, OfImpactsAloneIsThatOfTheirEquations) {
  const ImpactScene scene = lumped_bar(6, 0.5, 0.02, 0.8, 0.8, 0.9);
  const ContactDynamics dynamics(scene.structure());
  const PhasesProblem problem = scene.problem(dynamics);
  const ImpactResponse found = impact_response(problem);
  ASSERT_TRUE(found.motion.converged() && found.load_periods == 1);
  const SettledExact settled = settled_motion(
      {dynamics, ContactLaws(Obstacle{0.8, 0.8}), problem.contact_free, problem.frequency}, {}, {});
  ASSERT_TRUE(settled.motion.converged());
  ASSERT_EQ(settled.motion.impacts.size(), found.motion.impacts.size());
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(97, 0.0, 0.99);
  EXPECT_LT((settled.motion.displacement(times) - found.motion.displacement(times)).norm(), 1e-8);
  EXPECT_LT((settled.motion.velocity(times) - found.motion.velocity(times)).norm(), 1e-7);
  EXPECT_LT((settled.motion.force_harmonics(9) - found.motion.force_harmonics(9)).norm(), 1e-8);
}

// e = 0.3 between stops under a mean load: infinitely many impacts in a finite time, then rest. The same
// motion settles in time.
TEST(LastingContactTest, FollowsImpactsThatFollowEachOtherEverFaster) {
  const ImpactScene scene = impact_oscillator(0.1, 0.0, 0.3, 0.5);
  const ContactDynamics dynamics(scene.structure());
  const ImpactResponse found = impact_response(scene.problem(dynamics));
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  EXPECT_GT(found.motion.impacts.size(), 8u);
  EXPECT_EQ(found.unstable, 0);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(997, 0.0, 0.998);
  EXPECT_LE(found.motion.displacement(times).maxCoeff(), 1e-9);
  EXPECT_GE(found.motion.force(times).minCoeff(), -1e-12);
  const double opens = std::acos(0.0) / two_pi;  // where the load passes zero
  EXPECT_NEAR(found.motion.phases.back().end - 1.0, opens, 1e-10);
}

}  // namespace
}  // namespace wavebalance::solvers
