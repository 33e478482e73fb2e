// Random chains of one to ten contacts that open and rub: nine in ten have a response, and every response is
// a motion that integration in time leads back to itself after a period.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "campaign.hpp"
#include "period/modal_map.hpp"
#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/period/settling.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

// Unit masses that move along x and y between springs, each pressed against an obstacle along y on which it
// rubs along x; the last one is driven along both, with a phase.
FrictionScene random_chain_that_rubs(std::mt19937& generator) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const int masses = 1 + int(10 * any(generator)), size = 2 * masses;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < masses; ++i) {
    for (int d = 0; d < 2; ++d) {
      const int a = 2 * i + d, b = a + 2;
      stiffness(a, a) += 0.5 + 0.5 * any(generator);
      if (i + 1 == masses) continue;
      stiffness(a, a) += 2.0;
      stiffness(b, b) += 2.0;
      stiffness(a, b) = stiffness(b, a) = -2.0;
    }
    const double coupling = 0.3 * (any(generator) - 0.5);
    stiffness(2 * i, 2 * i + 1) += coupling;
    stiffness(2 * i + 1, 2 * i) += coupling;
  }
  const Eigen::MatrixXd damping = 0.05 * stiffness + 0.02 * Eigen::MatrixXd::Identity(size, size);
  const double mu = 0.2 + 0.6 * any(generator), normal_load = 0.5 * any(generator);
  const double normal = std::pow(10.0, 0.5 + 1.5 * any(generator));
  const double tangential = std::pow(10.0, 0.3 + 1.7 * any(generator));
  const contact::CoulombLaw law({mu, tangential, normal_load}, contact::LinearLaw(normal, 0.0));
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < masses; ++i) rows(2 * i, 2 * i + 1) = rows(2 * i + 1, 2 * i) = 1.0;
  const double amplitude = 0.5 + 2.0 * any(generator), omega = 0.4 + 1.6 * any(generator);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size), pressing = load, across = load;
  load[size - 2] = amplitude;
  load[1] += 0.5;
  across[size - 1] = 0.8 * amplitude;
  for (int i = 0; i < masses; ++i) pressing[2 * i + 1] = normal_load;
  FrictionScene scene =
      testing::friction_scene(Eigen::MatrixXd::Identity(size, size), damping, stiffness, rows, load, omega,
                              std::vector<contact::CoulombLaw>(static_cast<std::size_t>(masses), law));
  Eigen::VectorXcd constant(1), phased(2);
  constant << 1.0;
  phased << 0.0, std::polar(1.0, -1.0);
  scene.structure.forces.push_back({pressing, constant});
  scene.structure.forces.push_back({across, phased});
  return scene;
}

// The distance between the state at the beginning of a response and that a period later by integration in
// time, over the size of the former.
double distance_after_a_period(const FrictionScene& scene, CondensedProblem& problem,
                               const PeriodicResponse& response) {
  constexpr int steps = 1024;
  auto flow = ModalFlow::make(scene.structure, scene.frequency(), 1.0 / (scene.frequency() * steps), 60);
  const ContactLaws laws = scene.contact_laws();
  ModalMap map(problem, laws, steps, *std::move(flow));
  const Motion whole = structure_motion(problem, response, problem.points());
  PeriodState begin = map.state(whole.displacement.col(0), whole.velocity.col(0));
  for (Eigen::Index c = 0; c < problem.contacts(); ++c)
    begin.force[c] = response.contact_force[c * problem.points()];
  const Period period = map.advance(begin, {1e-9, 1e12});
  return (period.state.motion - begin.motion).norm() / begin.motion.norm();
}

// The same of 127 functions and 1024 points, from the motion of fewer on; infinite where none is found.
double finer_distance(const FrictionScene& scene, const PeriodicResponse& coarse, int points) {
  constexpr int functions = 127, finer_points = 1024;
  CondensedProblem problem(testing::fourier_pair(functions, finer_points), scene.structure,
                           testing::cosine_load());
  problem.set_frequency(scene.frequency());
  const Eigen::MatrixXd by_contact = coarse.displacement.reshaped(points, problem.contacts()).transpose();
  const PeriodicResponse finer =
      forced_response(problem, scene.contact_laws(), {}, resample(by_contact, finer_points, 0.0));
  return finer.converged() ? distance_after_a_period(scene, problem, finer)
                           : std::numeric_limits<double>::infinity();
}

TEST(RandomFrictionChains, HaveResponsesThatRepeatAfterAPeriod) {
  constexpr double same =
      0.05;  // of the state: the error of 31 functions, which an unstable motion multiplies
  const int count = campaign_seeds(6, 200);
  int solved = 0;
  double worst = 0.0, longest = 0.0;
  std::map<std::string, int> strategies;
  for (int seed = 1; seed <= count; ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    const FrictionScene scene = random_chain_that_rubs(generator);
    CondensedProblem problem(testing::fourier_pair(31, 256), scene.structure, testing::cosine_load());
    problem.set_frequency(scene.frequency());
    const auto start = std::chrono::steady_clock::now();
    const PeriodicResponse response = forced_response(problem, scene.contact_laws(), {});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    longest = std::max(longest, seconds);
    if (!response.converged()) {
      std::printf("seed %d, %zu contacts: %s after %.1f s\n", seed, scene.laws.size(),
                  std::string(to_string(response.status)).c_str(), seconds);
      continue;
    }
    ++solved;
    ++strategies[std::string(to_string(response.strategy))];
    double distance = distance_after_a_period(scene, problem, response);
    if (distance >= same) {
      std::printf("seed %d: distance %.1e with 31 functions\n", seed, distance);
      distance = finer_distance(scene, response, problem.points());
    }
    worst = std::max(worst, distance);
    EXPECT_LT(distance, same) << seed << ", " << scene.laws.size() << " contacts";
  }
  for (const auto& [strategy, times] : strategies) std::printf("%s: %d\n", strategy.c_str(), times);
  std::printf("%d of %d solved, the longest in %.1f s, worst distance %.1e\n", solved, count, longest, worst);
  EXPECT_GE(10 * solved, 9 * count);
}

// The balance has a solution near pieces of their motions that nearly return, which are as many as a fast
// integration gives.
TEST(RandomFrictionChains, HaveUnstableResponsesWhereTheirMotionsNeverRepeat) {
  for (const unsigned seed : {84U, 155U}) {
    std::mt19937 generator(seed);
    const FrictionScene scene = random_chain_that_rubs(generator);
    CondensedProblem problem(testing::fourier_pair(31, 256), scene.structure, testing::cosine_load());
    problem.set_frequency(scene.frequency());
    const PeriodicResponse response = forced_response(problem, scene.contact_laws(), {});
    EXPECT_TRUE(response.converged()) << seed;
    EXPECT_EQ(response.strategy, Strategy::recurrence) << seed;
    EXPECT_EQ(response.attractor_periods, 0) << seed;
  }
}

// An iteration of many contacts takes as much as several of these limits.
TEST(RandomFrictionChains, FallbacksHaveRoomForIterationsWhateverTheLimit) {
  std::mt19937 generator(44);
  const FrictionScene scene = random_chain_that_rubs(generator);
  CondensedProblem problem(testing::fourier_pair(31, 256), scene.structure, testing::cosine_load());
  problem.set_frequency(scene.frequency());
  ForcedResponseOptions options;
  options.max_fallback_operations = 1.0;
  const PeriodicResponse response = forced_response(problem, scene.contact_laws(), options);
  EXPECT_TRUE(response.converged());
  EXPECT_NE(response.strategy, Strategy::newton);
}

}  // namespace
}  // namespace wavebalance::solvers
