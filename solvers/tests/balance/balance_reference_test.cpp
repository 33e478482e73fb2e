#include <ostream>

#include "period_oracle/shooting.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

// The bar of [JL14, section 4] by harmonic balance, against shooting and against figures computed by others.
namespace wavebalance::solvers {
namespace {

constexpr int output_points = 1024;

PeriodicResponse solve(const testing::Jl14Case& reference, int functions, int points, Eigen::VectorXd& tip) {
  CondensedProblem problem =
      testing::fourier_problem(reference.structure(), functions, points, reference.frequency_hz);
  const PeriodicResponse response = forced_response(problem, reference.law, {});
  TrialEvaluator evaluate(problem.pair().trial(), output_points, 0);
  tip = evaluate(response.coefficients);
  return response;
}

const Eigen::VectorXd& shooting_tip(bool second_case) {
  static const auto run = [](const testing::Jl14Case& reference) {
    oracle::ShootingOptions options{.output_points = output_points};
    const oracle::ShootingResult result =
        oracle::shoot(reference.structure(), reference.law, reference.frequency_hz, options);
    EXPECT_EQ(result.status, oracle::ShootingStatus::converged);
    return Eigen::VectorXd(result.contacts.displacement.row(0));
  };
  static const std::array<Eigen::VectorXd, 2> tips{run(testing::jl14_case_1), run(testing::jl14_case_2)};
  return tips[second_case ? 1 : 0];
}

struct ErrorCase {
  bool second_case;
  int harmonics;
  int points;
  double error;  // relative rms of the tip displacement

  friend void PrintTo(const ErrorCase& one, std::ostream* out) {
    *out << one.harmonics << " harmonics, " << one.points << " points";
  }
};

class HarmonicBalanceError : public ::testing::TestWithParam<ErrorCase> {};

// Two per cent, and what three printed digits leave open for the smallest.
TEST_P(HarmonicBalanceError, IsThatOfAnIndependentComputation) {
  const auto [second_case, harmonics, points, error] = GetParam();
  Eigen::VectorXd tip;
  const auto& reference = second_case ? testing::jl14_case_2 : testing::jl14_case_1;
  const PeriodicResponse response = solve(reference, 2 * harmonics + 1, points, tip);
  ASSERT_TRUE(response.converged());
  EXPECT_EQ(response.strategy, Strategy::newton);
  const Eigen::VectorXd& exact = shooting_tip(second_case);
  EXPECT_NEAR((tip - exact).norm() / exact.norm(), error, 0.02 * error);
}

INSTANTIATE_TEST_SUITE_P(Case1, HarmonicBalanceError,
                         ::testing::Values(ErrorCase{false, 31, 256, 1.675e-3},
                                           ErrorCase{false, 31, 1024, 1.651e-3},
                                           ErrorCase{false, 63, 1024, 2.930e-4},
                                           ErrorCase{false, 127, 1024, 3.024e-5}));
INSTANTIATE_TEST_SUITE_P(Case2, HarmonicBalanceError,
                         ::testing::Values(ErrorCase{true, 31, 256, 9.917e-5},
                                           ErrorCase{true, 63, 1024, 1.842e-5},
                                           ErrorCase{true, 127, 1024, 9.33e-6},
                                           ErrorCase{true, 127, 4096, 1.06e-6}));

}  // namespace
}  // namespace wavebalance::solvers
