#include "support/duffing_spring.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::solvers {
namespace {

// With one harmonic, u = a cos, and the equivalent stiffness k(a), balance is a closed form for the load:
// F = a |k(a) - w^2 + i c w|.
double load_of(double amplitude, double stiffness, double damping, double w) {
  return amplitude * std::hypot(stiffness - w * w, damping * w);
}

TEST(AmplitudeSweep, PointsAndFoldsAreThoseOfTheClosedFormOfTheDuffingCurve) {
  const double damping = 0.05, w = 1.6;
  const auto load = [&](double a) { return load_of(a, 1.0 + 0.75 * a * a, damping, w); };
  double highest = 0.0, a_highest = 0.0, lowest = 1e9;
  for (double a = 0.0; a < 1.2; a += 1e-6)
    if (load(a) > highest) highest = load(a_highest = a);
  for (double a = a_highest; a < 2.5; a += 1e-6) lowest = std::min(lowest, load(a));
  CondensedProblem problem =
      testing::fourier_problem(testing::unit_oscillator(damping, 0.5), 3, 16, w / two_pi);
  FrequencySweepOptions options;
  for (const bool rising : {true, false}) {
    options.from = rising ? 0.1 : 3.0;
    options.to = rising ? 3.0 : 0.1;
    const FrequencySweep sweep = amplitude_sweep(problem, testing::DuffingSpring{}, options);
    ASSERT_EQ(sweep.status, SweepStatus::reached_end) << to_string(sweep.status);
    EXPECT_EQ(sweep.parameter, SweepParameter::load_scale);
    for (const SweepPoint& point : sweep.points) {
      const double a = std::sqrt(2.0) * point.rms_displacement;
      EXPECT_NEAR(load(a), 0.5 * point.load_scale, 1e-8);
      EXPECT_EQ(point.frequency, w / two_pi);
    }
    EXPECT_NEAR(sweep.points.back().load_scale, options.to, 1e-9);
    ASSERT_EQ(sweep.turning_points.size(), 2u);
    EXPECT_NEAR(0.5 * sweep.turning_points[rising ? 0 : 1].load_scale, highest, 1e-7);
    EXPECT_NEAR(0.5 * sweep.turning_points[rising ? 1 : 0].load_scale, lowest, 1e-7);
  }
}

// As in sweep_folds_test: in contact for |x| < b, with a mean in addition to the first harmonic.
TEST(AmplitudeSweep, FoldsAtAStopAreThoseOfTheClosedForm) {
  const double damping = 0.05, w = 1.15;
  const testing::LinearContact stop{.stiffness = 2.0, .start = 1.0};
  const auto load = [&](double b) {
    const double share = stop.stiffness / std::numbers::pi;
    const double amplitude = stop.start / (std::cos(b) - share * (std::sin(b) - b * std::cos(b)));
    return load_of(amplitude, 1.0 + share * (b - std::sin(b) * std::cos(b)), damping, w);
  };
  double lowest = 1e9, b_lowest = 0.0, highest = 0.0;
  for (double b = 0.0; b < 1.0; b += 1e-5)
    if (load(b) < lowest) lowest = load(b_lowest = b);
  for (double b = 0.0; b < b_lowest; b += 1e-5) highest = std::max(highest, load(b));
  ASSERT_LT(lowest, 0.9 * highest);
  CondensedProblem problem =
      testing::fourier_problem(testing::unit_oscillator(damping, 1.0), 3, 512, w / two_pi);
  const FrequencySweep sweep = amplitude_sweep(problem, stop, testing::between(0.05, 0.5));
  ASSERT_EQ(sweep.status, SweepStatus::reached_end);
  ASSERT_GE(sweep.turning_points.size(), 2u);
  EXPECT_NEAR(sweep.turning_points.front().load_scale, highest, 1e-4);
  EXPECT_NEAR(sweep.turning_points.back().load_scale, lowest, 1e-4);
}

TEST(AmplitudeSweep, OfAProblemWithoutAFrequencyIsRefused) {
  CondensedProblem problem = testing::fourier_problem(testing::unit_oscillator(0.1, 1.0), 3, 16);
  FrequencySweepOptions options = testing::between(1.0, 2.0);
  EXPECT_EQ(testing::refusal([&] { amplitude_sweep(problem, testing::DuffingSpring{}, options); }),
            "amplitude_sweep: the problem has no frequency yet; call set_frequency first");
}

}  // namespace
}  // namespace wavebalance::solvers
