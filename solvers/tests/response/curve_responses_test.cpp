// Motions of a curve at given frequencies, compared with the closed form of a Duffing oscillator.
#include "wavebalance/solvers/response/curve_responses.hpp"

#include "support/duffing_spring.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double curve_load = 0.3, curve_damping = 0.05;

CondensedProblem duffing() {
  return {testing::fourier_pair(3, 16), testing::unit_oscillator(curve_damping, curve_load),
          testing::cosine_load()};
}

FrequencySweep traced(CondensedProblem& problem, const ContactLaws& laws, double from, double to) {
  FrequencySweepOptions options = testing::between(from, to);
  return frequency_sweep(problem, laws, options);
}

// ((1 - w^2 + 3/4 A)^2 + (c w)^2) A - F^2 of the squared amplitude A.
double closed_form(double squared, double frequency) {
  const double w = two_pi * frequency, k = 1.0 + 0.75 * squared - w * w;
  return (k * k + curve_damping * curve_damping * w * w) * squared - curve_load * curve_load;
}

// The amplitudes at a frequency, the largest first.
std::vector<double> amplitudes(double frequency) {
  std::vector<double> found;
  constexpr double largest = 100.0, step = 1e-3;
  for (double upper = largest; upper > step; upper -= step) {
    double a = upper - step, b = upper;
    if (closed_form(a, frequency) * closed_form(b, frequency) >= 0.0) continue;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (a + b);
      (closed_form(middle, frequency) * closed_form(a, frequency) > 0.0 ? a : b) = middle;
    }
    found.push_back(std::sqrt(0.5 * (a + b)));
  }
  return found;
}

double amplitude_of(const PeriodicResponse& response) {
  return response.displacement.norm() * std::sqrt(2.0 / double(response.displacement.size()));
}

// As results in another unit leave them.
TEST(CurveResponses, AreThoseOfTheEndsAndOfPointsOfACurveThatWasRounded) {
  CondensedProblem problem = duffing();
  problem.set_frequency(0.1);
  const FrequencySweep curve = amplitude_sweep(problem, testing::DuffingSpring{}, testing::between(0.1, 2.0));
  ASSERT_EQ(curve.status, SweepStatus::reached_end);
  ASSERT_TRUE(curve.turning_points.empty());  // each load is passed once
  const std::vector<double> asked{curve.points.front().load_scale, curve.points[3].load_scale,
                                  curve.points.back().load_scale};
  int rounded = 0;
  for (double unit = 0.05; unit < 1.0; unit += 0.05) {
    FrequencySweep other = curve;
    for (SweepPoint& point : other.points) point.load_scale = point.load_scale * unit * (1.0 / unit);
    for (const double value : asked) {
      const auto found = responses_at(problem, testing::DuffingSpring{}, other, value);
      ASSERT_EQ(found.size(), 1u) << unit << ' ' << value;
      EXPECT_TRUE(found.front().converged());
    }
    rounded += other.points.back().load_scale != curve.points.back().load_scale ? 1 : 0;
  }
  EXPECT_GT(rounded, 0);
}

TEST(CurveResponses, AreApartOnTheTwoSidesOfAFold) {
  CondensedProblem problem = duffing();
  const FrequencySweep curve = traced(problem, testing::DuffingSpring{}, 0.05, 0.5);
  ASSERT_EQ(curve.turning_points.size(), 2u);
  for (const std::size_t turn : {0u, 1u}) {
    const double fold = curve.turning_points[turn].frequency, inwards = turn == 0 ? -1.0 : 1.0;
    for (const double apart : {1e-3, 1e-5, 1e-7}) {  // the last two lie between two points of the curve
      const double frequency = fold * (1.0 + inwards * apart);
      const auto found = responses_at(problem, testing::DuffingSpring{}, curve, frequency);
      ASSERT_EQ(found.size(), 3u) << apart;
      for (const auto& one : found) EXPECT_TRUE(one.converged()) << apart;
      const double first = amplitude_of(found[turn]), second = amplitude_of(found[turn + 1]);
      EXPECT_NEAR(closed_form(first * first, frequency), 0.0, 1e-9);
      EXPECT_NEAR(closed_form(second * second, frequency), 0.0, 1e-9);
      EXPECT_GT(first - second, 0.1 * std::sqrt(apart));
      EXPECT_LT(first - second, 10.0 * std::sqrt(apart));
    }
    const double beside = fold * (1.0 - inwards * 1e-7);
    EXPECT_EQ(responses_at(problem, testing::DuffingSpring{}, curve, beside).size(), 1u);
  }
}

TEST(CurveResponses, AreNoneAtAFrequencyBesideTheCurve) {
  CondensedProblem problem = duffing();
  const FrequencySweep curve = traced(problem, testing::DuffingSpring{}, 0.05, 0.1);
  EXPECT_TRUE(responses_at(problem, testing::DuffingSpring{}, curve, 0.2).empty());
  EXPECT_EQ(responses_at(problem, testing::DuffingSpring{}, curve, 0.05).size(), 1u);
  EXPECT_EQ(responses_at(problem, testing::DuffingSpring{}, curve, curve.points[3].frequency).size(), 1u);
}

TEST(CurveResponses, HoldTheForceOfARigidStop) {
  CondensedProblem problem =
      testing::fourier_problem(testing::unit_oscillator(curve_damping, curve_load), 15, 64);
  const testing::LinearContact stop{.stiffness = 1e6, .start = 1.0};  // as stiff: the force form
  const FrequencySweep curve = traced(problem, stop, 0.1, 0.2);
  ASSERT_EQ(curve.form, ContactForm::force);
  ASSERT_FALSE(curve.points.empty());
  const SweepPoint& last = curve.points.back();
  const PeriodicResponse response = curve_response(problem, stop, curve, last.frequency, last.unknown);
  EXPECT_LT(response.residual, 1e-8);
  EXPECT_NEAR(response.contact_force.maxCoeff(), last.max_force, 1e-9 * last.max_force);
  for (const auto& one : responses_at(problem, stop, curve, 0.15)) {
    EXPECT_TRUE(one.converged());
    EXPECT_EQ(one.series_flexibility.size(), 1);
  }
}

TEST(CurveResponses, RefuseACurveWithoutUnknowns) {
  CondensedProblem problem = duffing();
  FrequencySweep curve = traced(problem, testing::DuffingSpring{}, 0.05, 0.1);
  for (SweepPoint& point : curve.points) point.unknown.resize(0);
  EXPECT_THROW(responses_at(problem, testing::DuffingSpring{}, curve, 0.07), std::invalid_argument);
}

TEST(ForcedResponse, StaysOnTheUpperBranchFromAGuessThere) {
  CondensedProblem problem = duffing();
  constexpr double frequency = 0.3;
  problem.set_frequency(frequency);
  const std::vector<double> expected = amplitudes(frequency);
  ASSERT_EQ(expected.size(), 3u);
  const FrequencySweep curve = traced(problem, testing::DuffingSpring{}, 0.05, 0.5);
  const auto neighbours = responses_at(problem, testing::DuffingSpring{}, curve, 0.28);
  ForcedResponseOptions options;
  options.stay_near_guess = true;
  problem.set_frequency(frequency);
  const PeriodicResponse upper =
      testing::solved_response(problem, testing::DuffingSpring{}, options, neighbours.front().displacement);
  EXPECT_NEAR(amplitude_of(upper), expected[0], 1e-8);
  const PeriodicResponse lower =
      forced_response(problem, testing::DuffingSpring{}, options, neighbours.back().displacement);
  EXPECT_NEAR(amplitude_of(lower), expected[2], 1e-8);
}

TEST(ForcedResponse, FollowsAResidualFromAGuessThatNewtonsMethodDoesNotConvergeFrom) {
  CondensedProblem problem = duffing();
  problem.set_frequency(0.3);
  ForcedResponseOptions options;
  options.stay_near_guess = true;
  options.newton.min_step = 1.0;  // without a line search
  Eigen::VectorXd guess(problem.samples());
  for (int l = 0; l < guess.size(); ++l) guess[l] = 9.0 * std::sin(two_pi * l / double(guess.size()));
  const PeriodicResponse near = testing::solved_response(problem, testing::DuffingSpring{}, options, guess);
  EXPECT_EQ(near.strategy, Strategy::residual_homotopy);
  EXPECT_NEAR(amplitude_of(near), amplitudes(0.3)[0], 1e-8);
  options.fallbacks = false;
  EXPECT_FALSE(forced_response(problem, testing::DuffingSpring{}, options, guess).converged());
}

}  // namespace
}  // namespace wavebalance::solvers
