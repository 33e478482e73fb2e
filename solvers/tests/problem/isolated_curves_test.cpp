// Curves through motions that the structure converges to and that lie on no known curve.
#include "wavebalance/solvers/problem/isolated_curves.hpp"

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

/// Between its folds at 0.169936531088 and 0.195690553549 Hz it has three motions; 256 points move them by
/// 3e-5 Hz.
ContactProblem with_two_folds() {
  return {testing::fourier_pair(63, 256), testing::unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}};
}

IsolatedCurvesOptions between(double from, double to) {
  IsolatedCurvesOptions options;
  options.sweep.from = from;
  options.sweep.to = to;
  options.sweep.keep_unknowns = true;
  options.spacing = 0.02;
  return options;
}

// A curve that ended too early is followed to its end, and known again at its beginning.
TEST(IsolatedCurves, SayThatTheyMeetAKnownOne) {
  ContactProblem problem = with_two_folds();
  const IsolatedCurvesOptions options = between(0.13, 0.24);
  FrequencySweep known = problem.sweep(options.sweep);
  ASSERT_EQ(known.turning_points.size(), 2u);
  known.points.resize(known.points.size() / 6);
  known.turning_points.clear();
  known.status = SweepStatus::lost;
  ASSERT_LT(known.points.back().frequency, 0.18);
  const IsolatedCurves found = isolated_curves(problem, {&known}, options);
  ASSERT_EQ(found.curves.size(), 1u);
  EXPECT_EQ(found.curves.front().curve.status, SweepStatus::reached_end);
  EXPECT_EQ(found.curves.front().curve.turning_points.size(), 2u);
  EXPECT_TRUE(found.curves.front().meets_known);
}

TEST(IsolatedCurves, EndWhereTheObserverSaysSo) {
  ContactProblem problem = with_two_folds();
  IsolatedCurvesOptions options = between(0.24, 0.18);
  const FrequencySweep known = problem.sweep(options.sweep);
  int calls = 0;
  options.sweep.observer = [&](const Progress&) { return ++calls < 3; };
  const IsolatedCurves found = isolated_curves(problem, {&known}, options);
  EXPECT_TRUE(found.cancelled);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(found.frequencies.size(), 1u);
}

TEST(IsolatedCurves, RefuseOptionsOutOfRange) {
  ContactProblem problem = with_two_folds();
  IsolatedCurvesOptions options = between(0.24, 0.18);
  const FrequencySweep known = problem.sweep(options.sweep);
  options.random_starts = -1;
  EXPECT_THROW(isolated_curves(problem, {&known}, options), std::invalid_argument);
  options.random_starts = 1;
  options.spacing = -0.1;
  EXPECT_THROW(isolated_curves(problem, {&known}, options), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
