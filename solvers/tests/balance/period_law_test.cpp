// Laws over a period: of several rows and with memory. Their derivative in Newton's system by LU and by
// GMRES, and responses of a slider on an elastic tangential contact [Jenkins] against exact values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

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
struct Stop {
  double force(double u) const { return std::max(0.0, stiffness * (u - start)); }
  double tangent(double u) const { return u >= start ? stiffness : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }
  double stiffness = 3.0, start = 0.2;
};

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
  // constant motions that slip lie where stick begins, so that these pairs take another wedge in its place.
  ContactLaws laws(const CondensedProblem& problem) {
    if (problem.pair().trial().pointwise_derivatives() >= 1)
      return {{AnyContactLaw(Jenkins{2.0, 0.3}), AnyContactLaw(Wedge{})}};
    return {{AnyContactLaw(Wedge{}), AnyContactLaw(Stop{})}};
  }
  Eigen::VectorXd motion(CondensedProblem& problem) {
    Eigen::VectorXd moved;
    problem.apply(testing::random_vector(problem.samples(), generator_), moved);
    return problem.contact_free_response() - moved;
  }

  std::mt19937 generator_{11};
  LinearStructure structure_;
};

TEST_P(PeriodLawSystem, TheSolveInvertsTheDerivativeOfTheResidual) {
  CondensedProblem problem = this->problem(8, 32);
  ContactSystem system(problem, laws(problem));
  const Eigen::VectorXd u = motion(problem), r = testing::random_vector(problem.samples(), generator_);
  system.evaluate(u);
  EXPECT_FALSE(system.slopes().others.empty());
  ASSERT_TRUE(system.factorize());
  Eigen::VectorXd x;
  ASSERT_TRUE(system.solve(r, x));
  const double step = 1e-7 / x.cwiseAbs().maxCoeff();
  system.evaluate(u + step * x);
  const Eigen::VectorXd ahead = system.residual();
  system.evaluate(u - step * x);
  EXPECT_LE(((ahead - system.residual()) / (2.0 * step) - r).norm(), 1e-6 * (r.norm() + x.norm()));
}

TEST_P(PeriodLawSystem, SolutionsByGmresAndByLuAreEqualWithABorderToo) {
  CondensedProblem problem = this->problem(16, 96);
  ContactSystem system(problem, laws(problem));
  const Eigen::VectorXd u = motion(problem), r = testing::random_vector(problem.samples(), generator_),
                        b = testing::random_vector(problem.samples(), generator_),
                        c = testing::random_vector(problem.samples(), generator_);
  system.evaluate(u);
  Eigen::VectorXd by_lu, by_gmres, bordered_by_lu, bordered_by_gmres;
  double last_by_lu = 0.0, last_by_gmres = 0.0;
  system.set_linear_solver(LinearSolver::dense);
  ASSERT_TRUE(system.factorize() && system.solve(r, by_lu));
  ASSERT_TRUE(system.factorize_bordered(b, c, 0.7));
  ASSERT_TRUE(system.solve_bordered(r, 0.3, bordered_by_lu, last_by_lu));
  system.set_linear_solver(LinearSolver::krylov);
  ASSERT_TRUE(system.factorize() && system.solve(r, by_gmres, 1e-12));
  ASSERT_TRUE(system.factorize_bordered(b, c, 0.7));
  ASSERT_TRUE(system.solve_bordered(r, 0.3, bordered_by_gmres, last_by_gmres, 1e-12));
  EXPECT_LE((by_lu - by_gmres).norm(), 1e-9 * by_lu.norm());
  EXPECT_LE((bordered_by_lu - bordered_by_gmres).norm(), 1e-9 * bordered_by_lu.norm());
  EXPECT_NEAR(last_by_lu, last_by_gmres, 1e-9 * std::abs(last_by_lu));
}

INSTANTIATE_TEST_SUITE_P(PairKinds, PeriodLawSystem, ::testing::Range(0, testing::pair_kind_count));

TEST(PeriodLaw, OfSeveralRowsIsTheLawsOfOneInstantWhereTheseSayTheSame) {
  std::mt19937 generator(5);
  LinearStructure chain = testing::random_chain(4, generator);
  chain.contact_directions = contact_rows({1, 3}, 4);
  CondensedProblem problem(testing::fourier_pair(31, 128), chain, testing::cosine_load());
  problem.set_frequency(0.08);
  ForcedResponseOptions displacement;
  displacement.form = ContactForm::displacement;
  const PeriodicResponse together = forced_response(problem, Wedge{3.0, 0.2, 0.0}, displacement);
  const PeriodicResponse apart =
      forced_response(problem, ContactLaws({AnyContactLaw(Stop{}), AnyContactLaw()}), displacement);
  ASSERT_TRUE(together.converged() && apart.converged());
  EXPECT_GT(apart.contact_force.maxCoeff(), 0.0);
  EXPECT_LE((together.displacement - apart.displacement).norm(), 1e-12 * apart.displacement.norm());
  EXPECT_EQ(together.iterations, apart.iterations);
}

// m = k = kt = 1, c = 0.05, limit 1 N, load F cos(omega t): the first harmonic of the exact motion, from its
// flows between stick and slip.
struct Slider {
  double load, omega, amplitude;
};

TEST(PeriodLaw, ASliderHasTheAmplitudeOfItsExactMotionInSmoothPairs) {
  const spectral::FourierBasis fourier(63);
  for (const auto& [load, omega, amplitude] : {Slider{2.0, 1.2, 5.002826509},
                                               {1.5, 1.3, 2.877360723},
                                               {0.5, 1.41, 1.356058056},
                                               {2.0, 0.45, 1.097855263}})
    for (const TimePair& pair :
         {testing::fourier_pair(63, 1008),
          testing::make_pair(testing::CubicBasis{64}, testing::CubicBasis{64}, 1024)}) {
      CondensedProblem problem(pair, testing::unit_oscillator(0.05, load), testing::cosine_load());
      problem.set_frequency(omega / (2.0 * std::numbers::pi));
      const PeriodicResponse response = forced_response(problem, Jenkins{}, {});
      ASSERT_TRUE(response.converged()) << omega << to_string(response.status);
      EXPECT_LE(response.iterations, 20);
      std::complex<double> first = 0.0;
      for (Eigen::Index l = 0; l < response.displacement.size(); ++l)
        first += 2.0 * response.displacement[l] *
                 std::polar(1.0, 2.0 * std::numbers::pi * double(l) / double(response.displacement.size())) /
                 double(response.displacement.size());
      EXPECT_NEAR(std::abs(first), amplitude, 5e-5 * amplitude) << omega;
    }
}

TEST(PeriodLaw, ASliderIsFollowedThroughItsResonance) {
  CondensedProblem problem(testing::fourier_pair(31, 128), testing::unit_oscillator(0.05, 2.0),
                           testing::cosine_load());
  FrequencySweepOptions options;
  options.from = 0.45 / (2.0 * std::numbers::pi);
  options.to = 1.3 / (2.0 * std::numbers::pi);
  options.keep_unknowns = true;
  const FrequencySweep sweep = frequency_sweep(problem, Jenkins{}, options);
  ASSERT_EQ(sweep.status, SweepStatus::reached_end);
  ContactSystem system(problem, Jenkins{});
  double peak = 0.0;
  for (const SweepPoint& point : sweep.points) {
    problem.set_frequency(point.frequency);
    EXPECT_LE(system.evaluate(point.unknown), 1e-8) << point.frequency;
    peak = std::max(peak, point.max_displacement);
  }
  EXPECT_GT(peak, 15.3);
}

TEST(PeriodLaw, SaysThePieceOfEachSample) {
  CondensedProblem problem(testing::fourier_pair(31, 128), testing::unit_oscillator(0.05, 2.0),
                           testing::cosine_load());
  problem.set_frequency(1.2 / (2.0 * std::numbers::pi));
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
  CondensedProblem problem(testing::fourier_pair(7, 32), testing::unit_oscillator(0.1, 1.0),
                           testing::cosine_load());
  problem.set_frequency(0.2);
  EXPECT_THROW(forced_response(problem, Jenkins{}, force), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
