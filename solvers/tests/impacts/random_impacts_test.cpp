#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "campaign.hpp"
#include "constants.hpp"
#include "support/impact_oracle.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::ImpactOracle, testing::ImpactScene;

// A chain of 1 to 5 masses, or an oscillator, whose load reaches its obstacles.
ImpactScene random_scene(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const int size = 1 + static_cast<int>(5.0 * uniform(generator));
  ImpactScene scene;
  scene.mass = Eigen::MatrixXd::Zero(size, size);
  scene.stiffness = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    const double spring = 0.5 + 1.5 * uniform(generator);
    scene.mass(i, i) = 0.5 + uniform(generator);
    scene.stiffness(i, i) += spring;
    if (i == 0) continue;
    scene.stiffness(i - 1, i - 1) += spring;
    scene.stiffness(i, i - 1) = scene.stiffness(i - 1, i) = -spring;
  }
  scene.damping = (0.01 + 0.1 * uniform(generator)) * scene.stiffness + 0.02 * scene.mass;
  scene.load = Eigen::VectorXd::Unit(size, size - 1);
  scene.omega = 0.3 + 2.5 * uniform(generator);
  scene.restitution = 0.1 + 0.85 * uniform(generator);
  const bool both = uniform(generator) < 0.3;
  scene.contacts = Eigen::MatrixXd::Zero(both ? 2 : 1, size);
  scene.contacts(0, size - 1) = 1.0;
  if (both) scene.contacts(1, size > 1 && uniform(generator) < 0.5 ? 0 : size - 1) = -1.0;
  const Eigen::VectorXd reach = (scene.contacts * scene.free_amplitudes()).cwiseAbs();
  scene.gaps = (0.05 + 0.9 * uniform(generator)) * reach;
  return scene;
}

std::vector<ImpactOracle::Event> events_of(const PhaseMotion& motion, double period) {
  std::vector<ImpactOracle::Event> events;
  for (const Impact& impact : motion.impacts)
    events.push_back({impact.contact, impact.time * period, impact.velocity_before, impact.impulse});
  return events;
}

// The largest modulus of multipliers by differences of motions in time.
double growth_by_differences(const ImpactOracle& oracle, const Eigen::VectorXd& begin, double period) {
  constexpr double change = 1e-6;
  Eigen::MatrixXd monodromy(begin.size(), begin.size());
  for (Eigen::Index i = 0; i < begin.size(); ++i) {
    const Eigen::VectorXd step = change * Eigen::VectorXd::Unit(begin.size(), i);
    std::vector<ImpactOracle::Event> ignored;
    monodromy.col(i) = (oracle.advance(begin + step, 0.0, period, ignored) -
                        oracle.advance(begin - step, 0.0, period, ignored)) /
                       (2.0 * change);
  }
  return detail::eigenvalues(monodromy).cwiseAbs().maxCoeff();
}

TEST(RandomImpacts, AgreeWithMotionsInTimeOfRandomChains) {
  const unsigned seeds = static_cast<unsigned>(campaign_seeds(40, 200));
  int answered = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const ImpactScene scene = random_scene(seed);
    const ContactDynamics dynamics(scene.structure());
    const ImpactResponse found = impact_response(scene.problem(dynamics));
    if (!found.motion.converged() || found.lasts()) continue;
    ++answered;
    const ImpactOracle oracle(scene);
    const double period = found.load_periods * oracle.load_period();
    const auto expected = events_of(found.motion, period);
    const Eigen::VectorXd begin = oracle.periodic_state(expected, found.load_periods);
    std::vector<ImpactOracle::Event> events;
    const Eigen::VectorXd end = oracle.advance(begin, 0.0, period, events);
    const double growth = std::max(1.0, std::abs(found.multipliers[0]));
    EXPECT_LE((end - begin).norm(), 1e-8 * growth * begin.norm()) << seed;
    ASSERT_EQ(events.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_NEAR(events[i].time, expected[i].time, 1e-8 * growth * period) << seed;
      EXPECT_NEAR(events[i].velocity, expected[i].velocity, 1e-7 * growth) << seed;
      EXPECT_EQ(events[i].contact, expected[i].contact) << seed;
    }
    if (seed % 8 == 0 && !expected.empty()) {
      EXPECT_NEAR(growth_by_differences(oracle, begin, period), std::abs(found.multipliers[0]), 1e-3 * growth)
          << seed;
    }
  }
  EXPECT_GE(answered, seeds * 7 / 10);
}

}  // namespace
}  // namespace wavebalance::solvers
