// Laws over a period: of several rows and with memory. Their derivative in Newton's system by LU and by
// GMRES, and responses of a slider on an elastic tangential contact [Jenkins] against exact values.

#include "support/newton_checks.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

// A spring in series with a slider that yields at a limit: the force follows the increments of the
// displacement and is cut at the limit. The map of the force over one period is idempotent, so that the
// second of two periods is the periodic one.
struct Jenkins {
  double stiffness = 1.0, limit = 1.0;

  int rows() const { return 1; }
  void evaluate(const PeriodKinematics& motion, PeriodForces& out) const {
    const auto& u = motion.displacement;
    double force = 0.0;
    int slipped = -1;  // the last sample that slipped, to which later samples stick
    for (int step = 0; step < 2 * motion.points; ++step) {
      const int j = step % motion.points, before = (j + motion.points - 1) % motion.points;
      const double trial = force + stiffness * (u[std::size_t(j)] - u[std::size_t(before)]);
      force = std::clamp(trial, -limit, limit);
      const bool slips = force != trial;
      if (slips) slipped = j;
      if (step < motion.points) continue;
      out.force[std::size_t(j)] = force;
      out.piece[std::size_t(j)] = slips ? (force > 0.0 ? 1 : -1) : 0;
      if (slips) continue;
      out.displacement_slope[std::size_t(j)] = stiffness;
      if (slipped >= 0) out.others.push_back({j, slipped, -stiffness});
    }
  }
};
static_assert(PeriodLaw<Jenkins> && !ContactLaw<Jenkins>);

// A stop along the first row whose force pushes along the second, too.
struct Wedge {
  double stiffness = 3.0, gap = 0.2, slope = 0.4;

  int rows() const { return 2; }
  void evaluate(const PeriodKinematics& motion, PeriodForces& out) const {
    for (int j = 0; j < motion.points; ++j) {
      const double depth = motion.displacement[std::size_t(j)] - gap;
      if (depth <= 0.0) continue;
      const int along = j + motion.points;
      out.force[std::size_t(j)] = stiffness * depth;
      out.force[std::size_t(along)] = slope * stiffness * depth;
      out.displacement_slope[std::size_t(j)] = stiffness;
      out.others.push_back({along, j, slope * stiffness});
      out.piece[std::size_t(j)] = out.piece[std::size_t(along)] = 1;
    }
  }
};

// The wedge along its first row, as a law of one instant.
const testing::LinearContact wedge_stop{3.0, 0.2};

class PeriodLawSystem : public ::testing::TestWithParam<int> {
 protected:
  PeriodLawSystem() {
    LinearStructure chain = testing::random_chain(5, generator_);
    chain.contact_directions = contact_rows({1, 2, 4}, 5);
    structure_ = chain;
  }
  CondensedProblem problem(int functions, int points) {
    CondensedProblem problem(testing::pair_kinds(functions, points)[std::size_t(GetParam())], structure_,
                             testing::cosine_load());
    problem.set_frequency(0.17);
    return problem;
  }
  // A slider on the first row, a wedge on the other two: smooth near most motions. Samples of piecewise
  // constant motions that slip are where stick begins, so these pairs use another wedge instead.
  ContactLaws laws(const CondensedProblem& problem) {
    if (problem.pair().trial().pointwise_derivatives() >= 1)
      return {{AnyContactLaw(Jenkins{2.0, 0.3}), AnyContactLaw(Wedge{})}};
    return {{AnyContactLaw(Wedge{}), AnyContactLaw(wedge_stop)}};
  }
  Eigen::VectorXd motion(CondensedProblem& problem) {
    Eigen::VectorXd moved;
    problem.apply(testing::random_vector(problem.samples(), generator_), moved);
    return problem.linear_response() - moved;
  }

  std::mt19937 generator_{11};
  LinearStructure structure_;
};

TEST_P(PeriodLawSystem, TheSolveInvertsTheDerivativeOfTheResidual) {
  CondensedProblem problem = this->problem(8, 32);
  ContactSystem system(problem, laws(problem));
  testing::expect_solve_inverts_derivative(system, motion(problem), generator_, 1e-7);
  EXPECT_FALSE(system.slopes().others.empty());
}

TEST_P(PeriodLawSystem, SolutionsByGmresAndByLuAreEqualWithABorderToo) {
  CondensedProblem problem = this->problem(16, 96);
  ContactSystem system(problem, laws(problem));
  system.evaluate(motion(problem));
  testing::expect_gmres_equals_lu(system, problem.samples(), generator_);
}

INSTANTIATE_TEST_SUITE_P(PairKinds, PeriodLawSystem, ::testing::Range(0, testing::pair_kind_count));

TEST(PeriodLaw, OfSeveralRowsIsTheLawsOfOneInstantWhereTheseSayTheSame) {
  std::mt19937 generator(5);
  LinearStructure chain = testing::random_chain(4, generator);
  chain.contact_directions = contact_rows({1, 3}, 4);
  CondensedProblem problem = testing::fourier_problem(chain, 31, 128, 0.08);
  ForcedResponseOptions displacement;
  displacement.form = ContactForm::displacement;
  const PeriodicResponse together = testing::solved_response(problem, Wedge{3.0, 0.2, 0.0}, displacement);
  const PeriodicResponse apart = testing::solved_response(
      problem, ContactLaws({AnyContactLaw(wedge_stop), AnyContactLaw()}), displacement);
  EXPECT_GT(apart.contact_force.maxCoeff(), 0.0);
  EXPECT_LE((together.displacement - apart.displacement).norm(), 1e-12 * apart.displacement.norm());
  EXPECT_EQ(together.iterations, apart.iterations);
}

TEST(PeriodLaw, SaysThePieceOfEachSample) {
  CondensedProblem problem =
      testing::fourier_problem(testing::unit_oscillator(0.05, 2.0), 31, 128, 1.2 / (2.0 * std::numbers::pi));
  const PeriodicResponse response = forced_response(problem, Jenkins{}, {});
  ContactSystem system(problem, Jenkins{});
  system.evaluate(response.unknown);
  const double slipping = double((system.period_pieces() != 0).count()) / problem.points();
  EXPECT_NEAR(slipping, 0.711779414, 3.0 / problem.points());
}

TEST(PeriodLaw, WhatNeedsTheForceOfOneInstantRefusesIt) {
  EXPECT_EQ(
      testing::refusal([] { AnyContactLaw(Jenkins{}).force(0.1); }),
      "a contact law acts over a period, and what was asked for needs the force of one instant; responses "
      "and sweeps in the displacement form take such laws");
  EXPECT_EQ(
      testing::refusal([] { ContactLaws(Wedge{}).require(1); }),
      "ContactLaws: the laws act along 2 contact directions, but the structure has 1; a law over a period "
      "takes as many as it has rows");
  ForcedResponseOptions force;
  force.form = ContactForm::force;
  CondensedProblem problem = testing::fourier_problem(testing::unit_oscillator(0.1, 1.0), 7, 32, 0.2);
  EXPECT_THROW(forced_response(problem, Jenkins{}, force), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
