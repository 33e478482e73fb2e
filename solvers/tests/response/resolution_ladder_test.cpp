#include "wavebalance/solvers/response/resolution_ladder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const testing::ExponentialLaw law_1 = testing::jl14_case_1.law;

CondensedProblem bar_at(double frequency, int functions, int points) {
  CondensedProblem problem(testing::fourier_pair(functions, points), testing::jl14_case_1.structure(),
                           testing::cosine_load());
  problem.set_frequency(frequency);
  return problem;
}

CondensedProblem bar(int functions, int points) {
  return bar_at(testing::jl14_case_1.frequency_hz, functions, points);
}

CondensedProblem oscillator(const testing::Oscillator& one, int functions, int points) {
  CondensedProblem problem(testing::fourier_pair(functions, points), one.structure(), testing::cosine_load());
  problem.set_frequency(one.frequency);
  return problem;
}

template <class Basis>
ProblemFactory bar_in(Formulation formulation) {
  return [formulation](int functions, int points) {
    CondensedProblem problem(testing::make_pair(Basis{functions}, Basis{functions}, points, formulation),
                             testing::jl14_case_1.structure(), testing::cosine_load());
    problem.set_frequency(testing::jl14_case_1.frequency_hz);
    return problem;
  };
}

/// Displacement at 8192 points.
Eigen::VectorXd motion(const AnyTimeBasis& trial, const PeriodicResponse& response) {
  return TrialEvaluator(trial, 8192, 0)(response.coefficients);
}

Eigen::VectorXd finest() {
  CondensedProblem problem = bar(511, 4096);
  const PeriodicResponse response = forced_response(problem, law_1, {});
  EXPECT_TRUE(response.converged());
  return motion(problem.pair().trial(), response);
}

double distance(const Eigen::VectorXd& u, const Eigen::VectorXd& reference) {
  return (u - reference).norm() / reference.norm();
}

void expect_within(const ProblemFactory& make, LadderOptions options, const Eigen::VectorXd& reference) {
  const LadderResponse found = response_to_tolerance(make, law_1, options);
  ASSERT_TRUE(found.converged()) << to_string(found.status) << " at tolerance " << options.tolerance;
  EXPECT_LE(found.estimated_error, options.tolerance);
  EXPECT_LE(distance(motion(found.problem->pair().trial(), found.response), reference), 3 * options.tolerance)
      << "tolerance " << options.tolerance;
}

TEST(ResolutionLadder, MeetsItsTolerance) {
  const Eigen::VectorXd reference = finest();
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5})
    expect_within(bar, {.tolerance = tolerance}, reference);
}

TEST(ResolutionLadder, MeetsItsToleranceInBasesThatAreNotBandLimited) {
  const Eigen::VectorXd reference = finest();
  for (const double tolerance : {1e-1, 1e-2, 1e-3})
    expect_within(bar_in<testing::CubicBasis>(Formulation::weak),
                  {.tolerance = tolerance, .first_functions = 16, .first_points = 32}, reference);
}

TEST(ResolutionLadder, RecordsEveryRung) {
  int told = 0;
  LadderOptions options{.tolerance = 1e-4};
  options.observer = [&](const Progress& progress) {
    if (progress.phase == "refinement") ++told;
    return true;
  };
  const LadderResponse found = response_to_tolerance(bar, law_1, options);
  ASSERT_TRUE(found.converged());
  ASSERT_EQ(told, static_cast<int>(found.ladder.size()));
  ASSERT_GE(found.ladder.size(), 2u);
  double seconds = 0.0;
  for (std::size_t i = 0; i < found.ladder.size(); ++i) {
    const LadderRung& rung = found.ladder[i];
    EXPECT_LE(rung.residual, options.solver.newton.tolerance);
    EXPECT_EQ(rung.estimated_error <= options.tolerance, i + 1 == found.ladder.size());
    EXPECT_EQ(std::isnan(rung.change), i == 0);
    EXPECT_EQ(std::isnan(rung.estimated_error), i == 0);
    seconds += rung.seconds;
    if (i == 0) continue;
    EXPECT_GT(rung.functions + rung.points, found.ladder[i - 1].functions + found.ladder[i - 1].points);
  }
  EXPECT_LE(seconds, found.seconds);
  EXPECT_EQ(found.estimated_error, found.ladder.back().estimated_error);
  EXPECT_EQ(found.problem->pair().functions(), found.ladder.back().functions);
  EXPECT_EQ(found.response.displacement.size(), found.ladder.back().points);
}

TEST(ResolutionLadder, LinearResponseTakesTwoRungsAndIsRounding) {
  const LadderResponse found = response_to_tolerance(bar, AnyContactLaw(), {.tolerance = 1e-10});
  EXPECT_TRUE(found.converged());
  EXPECT_EQ(found.ladder.size(), 2u);
  EXPECT_LE(found.estimated_error, 1000 * eps);
}

TEST(ResolutionLadder, EstimateIsNearTheTrueErrorOnEveryRung) {
  const Eigen::VectorXd reference = finest();
  LadderOptions options{.tolerance = 1e-5};
  const LadderResponse found = response_to_tolerance(bar, law_1, options);
  ASSERT_TRUE(found.converged());
  for (const LadderRung& rung : found.ladder) {
    if (std::isnan(rung.estimated_error) || rung.points >= 1024) continue;  // the reference has 4096
    CondensedProblem problem = bar(rung.functions, rung.points);
    const PeriodicResponse response = forced_response(problem, law_1, {});
    const double true_error = distance(motion(problem.pair().trial(), response), reference);
    EXPECT_GT(rung.estimated_error, true_error / 3.0) << rung.functions << " functions";
    EXPECT_LT(rung.estimated_error, true_error * 20.0) << rung.functions << " functions";
    EXPECT_NEAR(std::hypot(rung.truncation, rung.quadrature), rung.estimated_error, 10 * eps);
  }
}

TEST(ResolutionLadder, ChangeIsTheErrorOfTheRungBefore) {
  const Eigen::VectorXd reference = finest();
  LadderOptions options{.tolerance = 1e-4};
  const LadderResponse found = response_to_tolerance(bar, law_1, options);
  ASSERT_GE(found.ladder.size(), 3u);
  const LadderRung& before = found.ladder[1];
  CondensedProblem problem = bar(before.functions, before.points);
  const PeriodicResponse response = forced_response(problem, law_1, {});
  const double true_error = distance(motion(problem.pair().trial(), response), reference);
  EXPECT_NEAR(found.ladder[2].change, true_error, 0.5 * true_error);
}

/// A stop half-way between the largest displacement and the largest at 64 points, rigid but for 1e-9: its
/// force is what keeps the motion from exceeding the gap.
std::vector<std::pair<testing::Oscillator, testing::LinearContact>> stops_between_points() {
  std::vector<std::pair<testing::Oscillator, testing::LinearContact>> stops;
  testing::Oscillator one;
  for (one.frequency = 20.0; one.frequency < 40.0; one.frequency += 0.5) {
    const double peak = std::abs(one.amplitude());
    const double seen = oscillator(one, 31, 64).contact_free_response().maxCoeff();
    if (seen < (1.0 - 5e-4) * peak) stops.push_back({one, {1e12, 0.5 * (seen + peak)}});
  }
  return stops;
}

TEST(ResolutionLadder, SeesAContactBetweenThePoints) {
  const LadderOptions options{.tolerance = 1e-3, .max_points = 1024};
  int compared = 0;
  for (const auto& [one, stop] : stops_between_points()) {
    const auto make = [&one = one](int functions, int points) { return oscillator(one, functions, points); };
    const LadderResponse found = response_to_tolerance(make, stop, options);
    ASSERT_GE(found.ladder.size(), 3u);
    EXPECT_LE(found.ladder[1].change, 1000 * eps) << "no contact at the points of the first two";
    EXPECT_GT(found.ladder[1].estimated_error, options.tolerance) << one.frequency << " Hz";
    EXPECT_NE(found.status, LadderStatus::stagnated) << one.frequency << " Hz";
    if (!found.converged())
      continue;  // above the natural frequency a rigid stop may have many answers, or none
    CondensedProblem fine = oscillator(one, 511, 4096);
    const PeriodicResponse exact = forced_response(fine, stop, {});
    ASSERT_TRUE(exact.converged()) << one.frequency << " Hz";
    ++compared;
    EXPECT_LE(
        distance(motion(found.problem->pair().trial(), found.response), motion(fine.pair().trial(), exact)),
        3 * options.tolerance)
        << one.frequency << " Hz";
  }
  EXPECT_GE(compared, 5);
}

void expect_covered(double frequency, double below) {
  const auto make = [frequency](int functions, int points) { return bar_at(frequency, functions, points); };
  CondensedProblem fine = make(1023, 8192);
  const testing::LinearContact stop{5e9, (1.0 - below) * fine.contact_free_response().maxCoeff()};
  const PeriodicResponse exact = forced_response(fine, stop, {});
  ASSERT_TRUE(exact.converged());
  const LadderResponse found = response_to_tolerance(make, stop, {.tolerance = 1e-5});
  ASSERT_TRUE(found.converged()) << to_string(found.status);
  for (const LadderRung& rung : found.ladder) {
    if (std::isnan(rung.estimated_error) || rung.points < 32) continue;
    CondensedProblem problem = make(rung.functions, rung.points);
    const PeriodicResponse response = forced_response(problem, stop, {});
    const double error = distance(motion(problem.pair().trial(), response), exact.displacement);
    EXPECT_LE(error, 3.0 * rung.estimated_error + 2e-6)  // the reference's own error
        << frequency << " Hz, " << below << " of the amplitude, " << rung.functions << " functions, "
        << rung.points << " points";
  }
}

TEST(ResolutionLadder, EstimateCoversContactsThatOneOrTwoPointsSee) {
  // Gaps just below the amplitude, so that the contact lasts from much less than a point to some points; the
  // damping moves it away from the points.
  for (double frequency = 150.0; frequency < 1000.0; frequency += 50.0)
    for (double below = 1e-4; below < 3e-2; below *= 2.0) expect_covered(frequency, below);
}

TEST(ResolutionLadder, SaysThatTheSizesDoNotSuffice) {
  LadderOptions options{.tolerance = 1e-6, .max_functions = 63, .max_points = 256};
  const LadderResponse found = response_to_tolerance(bar, law_1, options);
  EXPECT_EQ(found.status, LadderStatus::size_limit);
  EXPECT_FALSE(found.converged());
  EXPECT_TRUE(found.response.converged());
  EXPECT_GT(found.estimated_error, options.tolerance);
  EXPECT_LE(found.ladder.back().points, 256);
}

TEST(ResolutionLadder, SaysThatRoundingIsReached) {
  // Smooth all period long: the obstacle presses from the start on, and Fourier series converge to rounding.
  testing::ExponentialLaw pressing = law_1;
  pressing.start = -5e-3;
  const LadderOptions options{.tolerance = 1e-18};
  const LadderResponse found = response_to_tolerance(bar, pressing, options);
  EXPECT_EQ(found.status, LadderStatus::stagnated);
  EXPECT_LE(found.estimated_error, 1e-9);
}

TEST(ResolutionLadder, SaysThatARungHasNoResponse) {
  LadderOptions options;
  options.solver.newton.max_iterations = 1;
  options.solver.complementarity = false;
  const LadderResponse found = response_to_tolerance(bar, law_1, options);
  EXPECT_EQ(found.status, LadderStatus::not_converged);
  EXPECT_TRUE(std::isnan(found.estimated_error));
}

TEST(ResolutionLadder, StopsWhenTold) {
  LadderOptions options{.tolerance = 1e-8};
  options.observer = [](const Progress& progress) { return progress.phase != "refinement"; };
  const LadderResponse found = response_to_tolerance(bar, law_1, options);
  EXPECT_EQ(found.status, LadderStatus::cancelled);
  EXPECT_EQ(found.ladder.size(), 1u);
}

TEST(ResolutionLadder, RefusesOptionsOutOfRange) {
  for (const LadderOptions& options :
       {LadderOptions{.tolerance = 0.0}, LadderOptions{.tolerance = std::nan("")},
        LadderOptions{.first_functions = 0}, LadderOptions{.first_points = 6},
        LadderOptions{.max_functions = 6}, LadderOptions{.max_points = 7}})
    EXPECT_THROW(response_to_tolerance(bar, law_1, options), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
