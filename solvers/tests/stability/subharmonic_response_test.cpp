#include "wavebalance/solvers/branches/subharmonic_response.hpp"

#include <utility>

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"

namespace wavebalance::solvers {
namespace {

/// The load in harmonic `periods` of the motion's period.
Eigen::VectorXcd load_in(int periods) {
  Eigen::VectorXcd load = Eigen::VectorXcd::Zero(periods + 1);
  load[periods] = 1.0;
  return load;
}

/// A problem of `periods` periods of a load of this frequency (Hz).
CondensedProblem problem_of(TimePair pair, const LinearStructure& structure, int periods, double frequency) {
  CondensedProblem problem(std::move(pair), structure, load_in(periods));
  problem.set_frequency(frequency / periods);
  return problem;
}

const LinearStructure driven_oscillator = testing::unit_oscillator(0.1, 0.8);
const testing::LinearContact hard_stop{10.0, 0.1};

TEST(LoadPeriods, AreTheCommonDivisorOfTheHarmonics) {
  for (const int periods : {1, 2, 3, 5}) {
    const auto problem = problem_of(testing::fourier_pair(31, 64), driven_oscillator, periods, 0.3);
    EXPECT_EQ(load_periods(problem), periods);
  }
  Eigen::VectorXcd harmonics = Eigen::VectorXcd::Zero(10);
  harmonics[0] = harmonics[6] = harmonics[9] = 1.0;
  EXPECT_EQ(load_periods(CondensedProblem(testing::fourier_pair(31, 64), driven_oscillator, harmonics)), 3);
}

// Between its period doublings at 2.2062 and 2.9737 rad/s the motion of one period is unstable, and at 2.4
// rad/s the motion of two is itself doubled. Near both doublings the motion of two periods is nearest to
// it. The balance has an error of 2e-6 here.
TEST(SubharmonicResponse, OfAnOscillatorWithAStopIsTheExactMotionOfThePeriodsThatItSettlesTo) {
  const ContactDynamics dynamics(driven_oscillator);
  for (const auto& [periods, omega] : {std::pair{2, 2.25}, {2, 2.9}, {4, 2.4}}) {
    SCOPED_TRACE(omega);
    const int points = 1024 * periods;
    const TimePair pair = testing::fourier_pair(126 * periods + 1, points);
    auto problem = problem_of(pair, driven_oscillator, periods, omega / two_pi);
    const auto response = subharmonic_response(problem, hard_stop, &dynamics, {});
    ASSERT_TRUE(response.converged());
    EXPECT_EQ(motion_periods(problem, response), periods);
    EXPECT_EQ(unstable_multipliers(dynamics, problem, hard_stop, response).count, 0);
    EXPECT_EQ(settle(problem, hard_stop).attractor_periods, periods);
    const ExactSolution exact =
        exact_near_response(problem, hard_stop, response, dynamics, {.tolerance = 1e-9}).motion;
    ASSERT_TRUE(exact.converged());
    const Eigen::VectorXd expected =
        exact.displacement(Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points)).row(0);
    EXPECT_LE((response.displacement - expected).norm(), 5e-6 * expected.norm());
  }
}

// Nothing converges to an unstable motion. It is near the motion of one period, along its perturbation.
TEST(SubharmonicResponse, IsFoundFromAPerturbationWhereItIsUnstable) {
  const LinearStructure bar = testing::jl14_bar(25, 1.25e-6);
  testing::ExponentialLaw law = testing::jl14_case_2.law;
  law.start = 1e-4;
  const ContactDynamics dynamics(bar);
  auto problem = problem_of(testing::fourier_pair(125, 1024), bar, 2, 2850.0);
  const auto response = subharmonic_response(problem, law, &dynamics, {});
  ASSERT_TRUE(response.converged());
  EXPECT_EQ(motion_periods(problem, response), 2);
  EXPECT_EQ(response.strategy, Strategy::perturbation);
  EXPECT_NE(response.attractor_periods, 2);
  EXPECT_EQ(unstable_multipliers(dynamics, problem, law, response).count, 1);
}

// Without Floquet exponents, as of rigid contact.
TEST(SubharmonicResponse, OfOtherPairsIsFoundBySettling) {
  for (const auto& pair : {testing::make_pair(spectral::FourierBasis(64), spectral::FourierBasis(64), 512),
                           testing::make_pair(testing::HaarBasis{64}, spectral::FourierBasis(64), 512)}) {
    auto problem = problem_of(pair, driven_oscillator, 2, 2.5 / two_pi);
    const auto response = subharmonic_response(problem, hard_stop, nullptr, {});
    ASSERT_TRUE(response.converged());
    EXPECT_EQ(motion_periods(problem, response), 2);
    EXPECT_LE(response.residual, 1e-10);
  }
}

}  // namespace
}  // namespace wavebalance::solvers
