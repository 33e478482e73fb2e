#include "wavebalance/solvers/response/refinement.hpp"

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

const testing::ExponentialLaw law_1 = testing::jl14_case_1.law;

CondensedProblem bar_at(double frequency, int functions, int points) {
  return testing::fourier_problem(testing::jl14_case_1.structure(), functions, points, frequency);
}

CondensedProblem bar(int functions, int points) {
  return bar_at(testing::jl14_case_1.frequency_hz, functions, points);
}

/// Displacement at 8192 points.
Eigen::VectorXd motion(const AnyTimeBasis& trial, const PeriodicResponse& response) {
  return TrialEvaluator(trial, 8192, 0)(response.coefficients);
}

Eigen::VectorXd finest() {
  CondensedProblem problem = bar(511, 4096);
  const PeriodicResponse response = testing::solved_response(problem, law_1);
  return motion(problem.pair().trial(), response);
}

double distance(const Eigen::VectorXd& u, const Eigen::VectorXd& reference) {
  return (u - reference).norm() / reference.norm();
}

TEST(Refinement, RecordsEveryLevel) {
  int calls = 0;
  RefinementOptions options{.tolerance = 1e-4};
  options.observer = [&](const Progress& progress) {
    if (progress.phase == "refinement") ++calls;
    return true;
  };
  const RefinementResult found = response_to_tolerance(bar, law_1, options);
  ASSERT_TRUE(found.converged());
  ASSERT_EQ(calls, static_cast<int>(found.levels.size()));
  ASSERT_GE(found.levels.size(), 2u);
  double seconds = 0.0;
  for (std::size_t i = 0; i < found.levels.size(); ++i) {
    const RefinementLevel& level = found.levels[i];
    EXPECT_LE(level.residual, options.solver.newton.tolerance);
    EXPECT_EQ(level.estimated_error <= options.tolerance, i + 1 == found.levels.size());
    EXPECT_EQ(std::isnan(level.change), i == 0);
    EXPECT_EQ(std::isnan(level.estimated_error), i == 0);
    seconds += level.seconds;
    if (i == 0) continue;
    EXPECT_GT(level.functions + level.points, found.levels[i - 1].functions + found.levels[i - 1].points);
  }
  EXPECT_LE(seconds, found.seconds);
  EXPECT_EQ(found.estimated_error, found.levels.back().estimated_error);
  EXPECT_EQ(found.problem->pair().functions(), found.levels.back().functions);
  EXPECT_EQ(found.response.displacement.size(), found.levels.back().points);
}

TEST(Refinement, LinearResponseTakesTwoLevelsAndIsRounding) {
  const RefinementResult found = response_to_tolerance(bar, AnyContactLaw(), {.tolerance = 1e-10});
  EXPECT_TRUE(found.converged());
  EXPECT_EQ(found.levels.size(), 2u);
  EXPECT_LE(found.estimated_error, 1000 * eps);
}

TEST(Refinement, EstimateIsNearTheTrueErrorOnEveryLevel) {
  const Eigen::VectorXd reference = finest();
  RefinementOptions options{.tolerance = 1e-5};
  const RefinementResult found = response_to_tolerance(bar, law_1, options);
  ASSERT_TRUE(found.converged());
  for (const RefinementLevel& level : found.levels) {
    if (std::isnan(level.estimated_error) || level.points >= 1024) continue;  // the reference has 4096
    CondensedProblem problem = bar(level.functions, level.points);
    const PeriodicResponse response = forced_response(problem, law_1, {});
    const double true_error = distance(motion(problem.pair().trial(), response), reference);
    EXPECT_GT(level.estimated_error, true_error) << level.functions << " functions";
    EXPECT_LT(level.estimated_error, true_error * 20.0) << level.functions << " functions";
    EXPECT_NEAR(std::hypot(level.truncation, level.quadrature), level.estimated_error, 10 * eps);
  }
}

TEST(Refinement, ChangeIsTheErrorOfThePreviousLevel) {
  const Eigen::VectorXd reference = finest();
  RefinementOptions options{.tolerance = 1e-4};
  const RefinementResult found = response_to_tolerance(bar, law_1, options);
  ASSERT_GE(found.levels.size(), 3u);
  const RefinementLevel& before = found.levels[1];
  CondensedProblem problem = bar(before.functions, before.points);
  const PeriodicResponse response = forced_response(problem, law_1, {});
  const double true_error = distance(motion(problem.pair().trial(), response), reference);
  EXPECT_NEAR(found.levels[2].change, true_error, 0.5 * true_error);
}

TEST(Refinement, ReportsThatTheSizesDoNotSuffice) {
  RefinementOptions options{.tolerance = 1e-6, .max_functions = 63, .max_points = 256};
  const RefinementResult found = response_to_tolerance(bar, law_1, options);
  EXPECT_EQ(found.status, RefinementStatus::size_limit);
  EXPECT_FALSE(found.converged());
  EXPECT_TRUE(found.response.converged());
  EXPECT_GT(found.estimated_error, options.tolerance);
  EXPECT_LE(found.levels.back().points, 256);
}

TEST(Refinement, ReportsThatRoundingIsReached) {
  // The contact lasts all period, so that the motion is smooth and its Fourier series converges to rounding.
  testing::ExponentialLaw pressing = law_1;
  pressing.start = -5e-3;
  const RefinementOptions options{.tolerance = 1e-18};
  const RefinementResult found = response_to_tolerance(bar, pressing, options);
  EXPECT_EQ(found.status, RefinementStatus::stagnated);
  EXPECT_LE(found.estimated_error, 1e-9);
}

TEST(Refinement, ReportsThatLevelsHaveNoResponse) {
  RefinementOptions options;
  options.solver.newton.max_iterations = 1;
  options.solver.fallbacks = false;
  const RefinementResult found = response_to_tolerance(bar, law_1, options);
  EXPECT_EQ(found.status, RefinementStatus::not_converged);
  EXPECT_TRUE(std::isnan(found.estimated_error));
}

// With one step of Newton's method and one point of continuation no level has a response. Four levels are
// tried where the structure is known to converge to a motion, two where no fallback looks for that.
TEST(Refinement, TriesMoreLevelsWhereTheStructureSettlesToAMotion) {
  RefinementOptions options;
  options.solver.newton.max_iterations = 1;
  options.solver.continuation.max_points = 1;
  const auto tried = [&](bool fallbacks) {
    options.solver.fallbacks = fallbacks;
    const RefinementResult found = response_to_tolerance(bar, law_1, options);
    EXPECT_EQ(found.status, RefinementStatus::not_converged);
    return std::count_if(found.levels.begin(), found.levels.end(),
                         [](const RefinementLevel& level) { return level.points >= 32; });
  };
  EXPECT_EQ(tried(false), 2);
  EXPECT_EQ(tried(true), 4);
}

TEST(Refinement, StopsWhenTheObserverReturnsFalse) {
  RefinementOptions options{.tolerance = 1e-8};
  options.observer = [](const Progress& progress) { return progress.phase != "refinement"; };
  const RefinementResult found = response_to_tolerance(bar, law_1, options);
  EXPECT_EQ(found.status, RefinementStatus::cancelled);
  EXPECT_EQ(found.levels.size(), 1u);
}

TEST(Refinement, RefusesOptionsOutOfRange) {
  for (const RefinementOptions& options :
       {RefinementOptions{.tolerance = 0.0}, RefinementOptions{.tolerance = std::nan("")},
        RefinementOptions{.first_functions = 0}, RefinementOptions{.first_points = 6},
        RefinementOptions{.max_functions = 6}, RefinementOptions{.max_points = 7}})
    EXPECT_THROW(response_to_tolerance(bar, law_1, options), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
