// Counts of Floquet multipliers of random structures with elastic friction against differences of the map of
// a period in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "campaign.hpp"
#include "dense_algebra.hpp"
#include "period/modal_map.hpp"
#include "stability/friction_monodromy.hpp"
#include "support/random_friction.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene, testing::random_friction_scene;

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
  Eigen::VectorXd moduli = oracle::eigenvalues(slope).cwiseAbs();
  std::sort(moduli.begin(), moduli.end(), std::greater<>());
  return moduli;
}

TEST(RandomFrictionStability, CountsAreThoseOfDifferencesOfThePeriodMap) {
  const int count = campaign_seeds(15, 500);
  int compared = 0, unstable = 0, near = 0, unsolved = 0;
  double worst = 0.0;
  for (int seed = 1; seed <= count; ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    const FrictionScene scene = random_friction_scene(generator);
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
