// Structures with one to six contacts: most have a response, or a named motion of another period.
#include <gtest/gtest.h>

#include <cstdio>

#include "campaign.hpp"
#include "random_structures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace {

using namespace wavebalance;
using solvers::CondensationMethod;
using solvers::CondensedProblem;

CondensedProblem problem_of(const extremes::RandomStructure& drawn, CondensationMethod method) {
  CondensedProblem problem(app::make_pair(drawn.time), drawn.structure, Eigen::Vector2cd(0.0, 1.0), method);
  problem.set_frequency(drawn.frequency);
  return problem;
}

// By how much a response misses its law, relative to the largest force, and the motion under its forces by
// another condensation, relative to the contact-free one.
struct Misses {
  double law = 0.0, motion = 0.0;

  Misses(const extremes::RandomStructure& drawn, const solvers::PeriodicResponse& response) {
    CondensedProblem other = problem_of(drawn, CondensationMethod::dense);
    Eigen::VectorXd product;
    other.apply(response.contact_force, product);
    const Eigen::VectorXd& free = other.contact_free_response();
    const double size = free.cwiseAbs().maxCoeff() + product.cwiseAbs().maxCoeff();
    motion = (free - product - response.displacement).cwiseAbs().maxCoeff() / size;
    const double largest = response.contact_force.cwiseAbs().maxCoeff(), near = 1e-9 * size;
    for (int l = 0; l < other.samples(); ++l) {
      const int contact = l / other.points();
      const double force = response.contact_force[l];
      double held = response.unknown[l];
      if (response.series_flexibility.size() > 0) held -= response.series_flexibility[contact] * force;
      law = std::max({law, force - drawn.laws[contact].force(held + near),
                      drawn.laws[contact].force(held - near) - force});
    }
    if (largest > 0.0) law /= largest;
  }
};

// 1T, or a motion named as one that does not have the load's period.
bool is_answered(const solvers::PeriodicResponse& response) {
  return response.converged() || (response.attractor_periods >= 0 && response.attractor_periods != 1);
}

TEST(RandomStructures, MostAreAnsweredAndEveryAnswerHolds) {
  const int count = campaign_seeds(5, 150);
  int answered = 0, converged = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const extremes::RandomStructure drawn = extremes::random_structure(static_cast<std::uint64_t>(seed));
    CondensedProblem problem = problem_of(drawn, CondensationMethod::automatic);
    const solvers::PeriodicResponse response = solvers::forced_response(problem, drawn.laws, {});
    answered += is_answered(response) ? 1 : 0;
    converged += response.converged() ? 1 : 0;
    if (!response.converged()) continue;
    const Misses misses(drawn, response);
    EXPECT_LE(misses.law, 1e-6) << seed;
    EXPECT_LE(misses.motion, 1e-8) << seed;
  }
  std::printf("%d structures, %d answered, %d converged\n", count, answered, converged);
  // 105 of 150 seeds are answered and 91 converge; 5 and 4 of the first 5. The aim is 0.98.
  EXPECT_GE(answered, 0.65 * count) << answered << " of " << count;
  EXPECT_GE(converged, 0.55 * count) << converged << " of " << count;
}

}  // namespace
