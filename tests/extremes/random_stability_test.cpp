// The count of unstable multipliers against the monodromy, on random structures with a given stiffness of
// contact, which no scene has. Counts of responses are compared with matrix exponentials by pytest.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <vector>

#include "campaign.hpp"
#include "draw.hpp"
#include "random_structures.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace {

using namespace wavebalance;
using solvers::StabilityStatus;

/// Outcomes of the motions.
struct Outcomes {
  int drawn = 0, compared = 0, near = 0, unknown = 0, unstable = 0, wrong = 0;

  /// Counts and compares, where the stability is known and no multiplier lies within 0.01 of the circle.
  void compare(std::uint64_t seed, const solvers::ContactDynamics& dynamics,
               const solvers::PeriodicStiffness& stiffness, double frequency) {
    const auto count =
        solvers::unstable_multipliers(dynamics, stiffness, frequency, {.harmonics = 31, .max_states = 0});
    if (count.status != StabilityStatus::converged) {
      ++unknown;
      return;
    }
    const Eigen::ArrayXd moduli = solvers::monodromy(dynamics, stiffness, frequency).cwiseAbs().array();
    if (!moduli.isFinite().all()) {
      ++unknown;
      return;
    }
    if (((moduli - 1.0).abs() <= 0.01).any()) {
      ++near;
      return;
    }
    ++compared;
    unstable += count.count > 0 ? 1 : 0;
    wrong += count.count != (moduli > 1.0).count() ? 1 : 0;
    EXPECT_EQ(count.count, (moduli > 1.0).count())
        << "seed " << seed << ", largest modulus " << moduli.maxCoeff();
  }

  void print() const {
    std::printf("%d motions, %d compared (%d unstable, %d wrong), %d near the circle, %d unknown\n", drawn,
                compared, unstable, wrong, near, unknown);
  }
};

// Contacts that are closed for parts of the period with 0.1 to 10 times the static stiffness.
solvers::PeriodicStiffness draw_stiffness(std::uint64_t seed, const solvers::ContactDynamics& dynamics) {
  Draw draw(seed + 1000000);
  const Eigen::MatrixXd flexibility = dynamics.compliance(0.0, Eigen::VectorXd::Zero(1))
                                          .compliance.real()
                                          .reshaped(dynamics.contacts(), dynamics.contacts());
  solvers::PeriodicStiffness stiffness;
  std::vector<double> tangents;
  for (int c = 0; c < dynamics.contacts(); ++c) {
    const double begin = draw.uniform(0.0, 1.0);
    stiffness.intervals.push_back({c, begin, begin + draw.uniform(0.02, 0.5)});
    tangents.push_back(draw.magnitude(-1.0, 1.0) / flexibility(c, c));
  }
  stiffness.tangent = [tangents](int contact, double time) {
    return tangents[static_cast<std::size_t>(contact)] *
           (1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * time));
  };
  return stiffness;
}

TEST(RandomStability, CountsOfPrescribedStiffnessAreThoseOfTheMonodromy) {
  Outcomes outcomes;
  const int count = campaign_seeds(60, 2000);
  for (int seed = 1; seed <= count; ++seed) {
    const extremes::RandomStructure drawn = extremes::random_structure(static_cast<std::uint64_t>(seed));
    const solvers::ContactDynamics dynamics(drawn.structure);
    ++outcomes.drawn;
    outcomes.compare(static_cast<std::uint64_t>(seed), dynamics,
                     draw_stiffness(static_cast<std::uint64_t>(seed), dynamics), drawn.frequency);
  }
  outcomes.print();
  EXPECT_GE(outcomes.compared, count / 3);
  EXPECT_GE(outcomes.unstable, count / 30);
}

}  // namespace
