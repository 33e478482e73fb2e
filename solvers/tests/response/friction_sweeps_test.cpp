// Sweeps of structures that rub: their curves have corners where contacts begin to slip, some of which turn
// back.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "campaign.hpp"
#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionScene;

/// A chain of unit masses between springs of 1, clamped at one end, of which one rubs under a constant limit.
struct RubbingChain {
  int masses, rubbing, driven;  // the last two from 0
  double tangential, limit, load;

  FrictionScene scene() const {
    Eigen::MatrixXd stiffness = 2.0 * Eigen::MatrixXd::Identity(masses, masses);
    for (int i = 1; i < masses; ++i) stiffness(i, i - 1) = stiffness(i - 1, i) = -1.0;
    stiffness(masses - 1, masses - 1) = 1.0;
    const Eigen::MatrixXd row = Eigen::RowVectorXd::Unit(masses, rubbing);
    return testing::friction_scene(Eigen::MatrixXd::Identity(masses, masses), 0.01 * stiffness, stiffness,
                                   row, load * Eigen::VectorXd::Unit(masses, driven), 1.0,
                                   {contact::CoulombLaw({1.0, tangential, limit})});
  }
};

/// Over its first resonances without friction, from one end or the other.
FrequencySweepOptions over_resonances(const FrictionScene& scene, bool upwards) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(Eigen::MatrixXd(scene.structure.stiffness));
  const Eigen::VectorXd hertz = modes.eigenvalues().cwiseSqrt() / (2.0 * std::numbers::pi);
  FrequencySweepOptions options;
  options.from = 0.3 * hertz[0];
  options.to = 1.3 * hertz[std::min<Eigen::Index>(2, hertz.size() - 1)];
  if (!upwards) std::swap(options.from, options.to);
  options.keep_unknowns = true;
  return options;
}

ContactProblem problem_of(const FrictionScene& scene) {
  return {testing::fourier_pair(31, 124), scene.structure, scene.contact_laws()};
}

/// Whether all responses of one curve at a frequency are responses of the other.
bool holds_all(ContactProblem& problem, const FrequencySweep& one, const FrequencySweep& other,
               double frequency) {
  const std::vector<PeriodicResponse> wanted = problem.responses_at(one, frequency),
                                      there = problem.responses_at(other, frequency);
  return std::ranges::all_of(wanted, [&](const PeriodicResponse& a) {
    return std::ranges::any_of(there, [&](const PeriodicResponse& b) {
      return (a.displacement - b.displacement).norm() <= 1e-5 * a.displacement.norm();
    });
  });
}

TEST(FrictionSweeps, TurnCornersOfMoreThanARightAngle) {
  const FrictionScene scene = RubbingChain{3, 1, 1, 20.0, 0.86, 1.72}.scene();
  for (const bool upwards : {true, false}) {
    ContactProblem problem = problem_of(scene);
    const FrequencySweep curve = problem.sweep(over_resonances(scene, upwards));
    EXPECT_EQ(curve.status, SweepStatus::reached_end) << upwards;
    for (const SweepPoint& point : curve.points) EXPECT_LE(point.residual, 1e-9);
  }
}

TEST(RandomFrictionSweeps, AreTheSameCurvesFromBothEnds) {
  const int count = campaign_seeds(2, 60);
  int ended = 0, same = 0;
  for (int seed = 0; seed < count; ++seed) {
    std::mt19937 generator(static_cast<unsigned>(seed));
    const auto any = [&](int least, int most) {
      return std::uniform_int_distribution<int>(least, most)(generator);
    };
    RubbingChain chain{any(2, 4), 0, 0, std::vector{1.0, 5.0, 20.0, 100.0}[std::size_t(any(0, 3))], 0.0, 0.0};
    chain.rubbing = any(0, chain.masses - 1);
    chain.driven = any(0, chain.masses - 1);
    chain.limit = std::uniform_real_distribution<double>(0.2, 2.0)(generator);
    chain.load = chain.limit * std::vector{1.2, 2.0, 5.0}[std::size_t(any(0, 2))];
    const FrictionScene scene = chain.scene();
    ContactProblem problem = problem_of(scene);
    const FrequencySweepOptions up = over_resonances(scene, true);
    const FrequencySweep one = problem.sweep(up), other = problem.sweep(over_resonances(scene, false));
    const bool ends = one.status == SweepStatus::reached_end && other.status == SweepStatus::reached_end;
    bool equal = ends;
    for (const double share : {0.2, 0.4, 0.6, 0.8})
      equal = equal && holds_all(problem, one, other, up.from + share * (up.to - up.from)) &&
              holds_all(problem, other, one, up.from + share * (up.to - up.from));
    if (!equal)
      std::printf("seed %d: %s, %s\n", seed, std::string(to_string(one.status)).c_str(),
                  std::string(to_string(other.status)).c_str());
    ended += ends ? 1 : 0;
    same += equal ? 1 : 0;
  }
  std::printf("%d of %d chains: both sweeps end, %d the same\n", ended, count, same);
  EXPECT_GE(100 * ended, 95 * count);
  EXPECT_GE(100 * same, 90 * count);
}

}  // namespace
}  // namespace wavebalance::solvers
