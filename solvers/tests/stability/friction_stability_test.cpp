// Floquet multipliers of motions with elastic friction against those of event-driven exact motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stability/friction_monodromy.hpp"
#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

struct Solved {
  PeriodicResponse response;
  PeriodicStiffness stiffness;
  Eigen::VectorXcd multipliers;
  UnstableMultipliers count;
};

Solved solve(const FrictionScene& scene, int functions, int points) {
  CondensedProblem problem(testing::fourier_pair(functions, points), scene.structure, testing::cosine_load());
  problem.set_frequency(scene.frequency());
  Solved solved;
  solved.response = forced_response(problem, scene.contact_laws(), {});
  if (!solved.response.converged()) return solved;
  const ContactDynamics dynamics(scene.structure);
  solved.stiffness = contact_stiffness(problem, scene.contact_laws(), solved.response);
  if (solved.stiffness.status != StabilityStatus::converged) return solved;
  solved.multipliers = friction_monodromy(dynamics, solved.stiffness, scene.frequency());
  solved.count = unstable_multipliers(dynamics, problem, scene.contact_laws(), solved.response);
  return solved;
}

struct Row {
  const char* name;
  FrictionScene scene;
  std::vector<std::complex<double>> multipliers;  // the largest, Im >= 0
};

// Of event-driven integrations with the saltation of their transitions.
TEST(FrictionStability, HasTheMultipliersOfTheExactMotions) {
  using namespace testing;
  using C = std::complex<double>;
  const std::vector<Row> rows{
      {"masses 1", rubbing_masses(1.0, 20.0, 1.0, 1.1), {0.92711204, C(-0.43778207, 0.39083673), 0.54246248}},
      {"masses 2",
       rubbing_masses(1.0, 2.0, 0.3, 1.1),
       {C(0.73178277, 0.45130763), C(-0.67897391, 0.35792914)}},
      {"lift-off",
       lift_off(2.0, 2.0, 0.6, 0.5, 3.0),
       {C(0.46568686, 0.43774878), C(-0.49607788, 0.10678992)}},
      {"unstable poles", rubbing_masses(0.6, 2.0, 0.3, 1.1, -0.06), {C(0.77374304, 0.44865851)}},
  };
  for (const Row& row : rows) {
    const Solved solved = solve(row.scene, 127, 2048);
    ASSERT_TRUE(solved.response.converged()) << row.name;
    ASSERT_EQ(solved.stiffness.status, StabilityStatus::converged);
    for (const C& exact : row.multipliers) {
      const double apart = (solved.multipliers.array() - exact).abs().minCoeff();
      EXPECT_LE(apart, 1e-4) << row.name << ' ' << exact << '\n' << solved.multipliers.transpose();
    }
    EXPECT_EQ(solved.count.count, 0) << row.name;
  }
}

struct Modulus {
  const char* name;
  FrictionScene scene;
  double largest, second;
};

TEST(FrictionStability, HasTheTwoLargestModuliOfTheExactMotions) {
  using namespace testing;
  const std::vector<Modulus> rows{{"Jenkins 1", slider_on_oscillator(2.0, 1.0, 1.0), 0.85325385, 0.65482821},
                                  {"Jenkins 2", slider_on_oscillator(2.0, 1.0, 1.2), 0.64754840, 0.64754840},
                                  {"Jenkins 4", slider_on_oscillator(0.5, 1.0, 1.41), 0.22235916, 0.22235916},
                                  {"Jenkins 6", slider_on_oscillator(1.5, 10.0, 1.1), 0.50867709, 0.50867709},
                                  {"masses 2", rubbing_masses(1.0, 2.0, 0.3, 1.0), 0.93907670, 0.90339657},
                                  {"masses 3", rubbing_masses(1.0, 2.0, 0.3, 1.7), 0.92230190, 0.92230190},
                                  {"masses 4", rubbing_masses(1.0, 2.0, 0.3, 0.6), 0.77228987, 0.73216139},
                                  {"masses 5", rubbing_masses(0.3, 20.0, 1.0, 1.4), 0.90334314, 0.90334314},
                                  {"lift-off 2", lift_off(2.0, 0.3, 0.8, 0.5, 3.6), 0.68426516, 0.68426516},
                                  {"lift-off 3", lift_off(1.0, 1.0, 0.6, 0.5, 2.4), 0.60672739, 0.60672739},
                                  {"lift-off 4", lift_off(3.0, 3.0, 0.6, 0.3, 4.5), 0.73159211, 0.73159211},
                                  {"lift-off 5", lift_off(2.0, 2.0, 0.6, 0.5, 5.2), 0.73791930, 0.73791930},
                                  {"beam 1", cantilever(200.0, 1e7, 500.0, 21.0), 0.71382433, 0.71382433},
                                  {"beam 4", cantilever(200.0, 1e8, 300.0, 25.0), 0.64718010, 0.64718010},
                                  {"chain 1", chain_of_three(6.0, 1.0), 0.83426451, 0.83426451},
                                  {"chain 2", chain_of_three(3.0, 0.85), 0.78746749, 0.78746749}};
  for (const Modulus& row : rows) {
    const Solved solved = solve(row.scene, 127, 2048);
    ASSERT_TRUE(solved.response.converged()) << row.name;
    ASSERT_EQ(solved.stiffness.status, StabilityStatus::converged);
    EXPECT_NEAR(std::abs(solved.multipliers[0]), row.largest, 1e-4) << row.name;
    EXPECT_NEAR(std::abs(solved.multipliers[1]), row.second, 1e-4) << row.name;
  }
}

TEST(FrictionStability, OfAContactThatSticksAlwaysIsThatOfItsSpring) {
  FrictionScene scene = testing::rubbing_masses(1.0, 2.0, 100.0, 1.1);
  const Solved stuck = solve(scene, 31, 128);
  ASSERT_TRUE(stuck.response.converged());
  LinearStructure spring = scene.structure;
  spring.stiffness.coeffRef(0, 0) += 2.0;
  const ContactDynamics dynamics(spring);
  for (const ContactPole& pole : dynamics.poles()) {
    const std::complex<double> exact = std::exp(pole.exponent / scene.frequency());
    EXPECT_LE((stuck.multipliers.array() - exact).abs().minCoeff(), 1e-10);
  }
  EXPECT_EQ(stuck.count.count, 0);
}

}  // namespace
}  // namespace wavebalance::solvers
