// Floquet multipliers of motions with elastic friction: against those of event-driven exact motions, and
// counts against differences of the map of a period in time.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "campaign.hpp"

#include "period/modal_map.hpp"
#include "stability/friction_monodromy.hpp"
#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
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

// Chains of masses that move along x and y, pressed against obstacles along y on which they rub along x, or
// rub under a constant load. Some dampers are negative, so that without contact the structure is unstable.
FrictionScene random_scene(std::mt19937& generator) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const int masses = 1 + int(3 * any(generator)), size = 2 * masses;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) stiffness(i, i) = 4.0 + 8.0 * any(generator);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < i; ++j) stiffness(i, j) = stiffness(j, i) = -2.0 * any(generator) / masses;
  Eigen::MatrixXd damping = 0.02 * stiffness;
  damping.diagonal().array() += 0.1 * any(generator);
  if (any(generator) < 0.4) damping(0, 0) -= 0.5 * any(generator);
  std::vector<contact::CoulombLaw> laws;
  std::vector<Eigen::RowVectorXd> rows;
  const auto unit = [&](int dof) { return Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(size, dof)); };
  Eigen::VectorXd load = Eigen::VectorXd::NullaryExpr(size, [&] { return 2.0 * any(generator) - 0.5; }),
                  at_rest = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < masses; ++i) {
    const double normal_load = 0.1 + any(generator), mu = 0.1 + 0.5 * any(generator);
    if (any(generator) < 0.5) {
      laws.emplace_back(contact::FrictionParameters{mu, 2.0 + 10.0 * any(generator), normal_load});
    } else {
      laws.emplace_back(contact::FrictionParameters{mu, 2.0 + 10.0 * any(generator), normal_load},
                        contact::LinearLaw(5.0 + 20.0 * any(generator), 0.0));
      rows.push_back(unit(2 * i + 1));
      at_rest[2 * i + 1] = normal_load;
    }
    rows.push_back(unit(2 * i));
  }
  Eigen::MatrixXd directions(Eigen::Index(rows.size()), size);
  for (std::size_t i = 0; i < rows.size(); ++i) directions.row(Eigen::Index(i)) = rows[i];
  FrictionScene scene = testing::friction_scene(Eigen::MatrixXd::Identity(size, size), damping, stiffness,
                                                directions, load, 1.0 + 3.0 * any(generator), laws);
  Eigen::VectorXcd constant(1);
  constant << 1.0;
  scene.structure.forces.push_back({at_rest, constant});
  return scene;
}

// Moduli of the eigenvalues of the map of a period at a response, by differences of its integration in time,
// the largest first. The forces along the tangents are part of the state.
Eigen::VectorXd moduli_by_differences(const FrictionScene& scene, CondensedProblem& problem,
                                      const PeriodicResponse& response) {
  constexpr int steps = 256;
  constexpr double change = 1e-6;
  const ContactLaws laws = scene.contact_laws();
  auto flow = ModalFlow::make(scene.structure, scene.frequency(), 1.0 / (scene.frequency() * steps), 60);
  ModalMap map(problem, laws, steps, *std::move(flow));
  const Motion whole = structure_motion(problem, response, problem.points());
  PeriodState begin = map.state(whole.displacement.col(0), whole.velocity.col(0));
  std::vector<Eigen::Index> tangents;
  Eigen::Index row = 0;
  for (const contact::CoulombLaw& law : scene.laws) {
    for (int i = 0; i < law.tangents(); ++i) tangents.push_back(row + law.normal_rows() + i);
    row += law.rows();
  }
  for (Eigen::Index c = 0; c < row; ++c) begin.force[c] = response.contact_force[c * problem.points()];
  const Eigen::Index states = begin.motion.size(), size = states + Eigen::Index(tangents.size());
  const auto end = [&](Eigen::Index which, double by) {
    PeriodState state = begin;
    if (which < states)
      state.motion[which] += by;
    else
      state.force[tangents[std::size_t(which - states)]] += by;
    const Period period = map.advance(state, {1e-9, 1e12});
    Eigen::VectorXd result(size);
    result << period.state.motion, period.state.force(tangents);
    return result;
  };
  Eigen::MatrixXd slope(size, size);
  for (Eigen::Index i = 0; i < size; ++i) slope.col(i) = (end(i, change) - end(i, -change)) / (2.0 * change);
  Eigen::VectorXd moduli = slope.eigenvalues().cwiseAbs();
  std::sort(moduli.begin(), moduli.end(), std::greater<>());
  return moduli;
}

TEST(FrictionStability, CountsOfRandomStructuresAreThoseOfDifferencesOfThePeriodMap) {
  const int count = campaign_seeds(15, 500);
  int compared = 0, unstable = 0, near = 0, unsolved = 0;
  double worst = 0.0;
  for (int seed = 1; seed <= count; ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    const FrictionScene scene = random_scene(generator);
    CondensedProblem problem(testing::fourier_pair(127, 1024), scene.structure, testing::cosine_load());
    problem.set_frequency(scene.frequency());
    const PeriodicResponse response = forced_response(problem, scene.contact_laws(), {});
    unsolved += response.converged() ? 0 : 1;
    if (!response.converged()) continue;
    const ContactDynamics dynamics(scene.structure);
    const PeriodicStiffness stiffness = contact_stiffness(problem, scene.contact_laws(), response);
    ASSERT_EQ(stiffness.status, StabilityStatus::converged) << seed;
    // A slider that sticks always keeps the neutral multiplier 1, which is left out.
    if (std::any_of(stiffness.friction.begin(), stiffness.friction.end(),
                    [](const FrictionAlong& one) { return one.always_sticks(); }))
      continue;
    const Eigen::VectorXcd multipliers = friction_monodromy(dynamics, stiffness, scene.frequency());
    const Eigen::VectorXd moduli = moduli_by_differences(scene, problem, response);
    const double apart = std::abs(std::abs(multipliers[0]) - moduli[0]);
    worst = std::max(worst, apart / moduli[0]);
    near += std::abs(moduli[0] - 1.0) < 0.01 ? 1 : 0;
    if (((moduli.array() - 1.0).abs() < 0.01).any()) continue;
    ++compared;
    unstable += moduli[0] > 1.0 ? 1 : 0;
    EXPECT_EQ((multipliers.array().abs() > 1.0).count(), (moduli.array() > 1.0).count())
        << seed << ' ' << multipliers.cwiseAbs().head(3).transpose() << " and " << moduli.head(3).transpose();
  }
  std::printf("%d drawn, %d compared, %d unstable, %d near, %d unsolved, worst %.1e\n", count, compared,
              unstable, near, unsolved, worst);
  EXPECT_GE(compared, count / 2);
}

}  // namespace
}  // namespace wavebalance::solvers
