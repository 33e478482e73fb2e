// Floquet multipliers of motions with elastic friction compared with event-driven exact motions.

#include "stability/switching_monodromy.hpp"
#include "support/friction_table.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
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
  CondensedProblem problem = testing::fourier_problem(scene.structure, functions, points, scene.frequency());
  Solved solved;
  solved.response = forced_response(problem, scene.contact_laws(), {});
  if (!solved.response.converged()) return solved;
  const ContactDynamics dynamics(scene.structure);
  solved.stiffness = contact_stiffness(problem, scene.contact_laws(), solved.response);
  if (solved.stiffness.status != StabilityStatus::converged) return solved;
  solved.multipliers = switching_monodromy(dynamics, solved.stiffness, scene.frequency());
  solved.count = unstable_multipliers(dynamics, problem, scene.contact_laws(), solved.response);
  return solved;
}

struct Row {
  const char* name;
  FrictionScene scene;
  std::vector<std::complex<double>> multipliers;  // the largest, Im >= 0
};

// From event-driven integrations with the saltation of their transitions.
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

TEST(FrictionStability, HasTheTwoLargestModuliOfTheExactMotions) {
  for (const testing::FrictionRow& row : testing::friction_rows()) {
    if (row.scene.laws.front().tangents() > 1) continue;
    const Solved solved = solve(row.scene, 127, 2048);
    ASSERT_TRUE(solved.response.converged()) << row.name;
    ASSERT_EQ(solved.stiffness.status, StabilityStatus::converged);
    const double allowed =
        row.name == "Jenkins 7" ? 5e-4 : 1e-4;  // the stiffest slider, at the lowest frequency
    EXPECT_NEAR(std::abs(solved.multipliers[0]), row.largest, allowed) << row.name;
    EXPECT_NEAR(std::abs(solved.multipliers[1]), row.second, allowed) << row.name;
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
