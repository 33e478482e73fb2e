// Exact solutions along a curve: the same for any number of threads.
#include "wavebalance/solvers/problem/exact_along.hpp"

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

ContactProblem stopped_oscillator() {
  return {testing::fourier_pair(31, 256), testing::unit_oscillator(0.1, 0.8),
          testing::LinearContact{10.0, 0.1}};
}

FrequencySweep curve_of_oscillator() {
  FrequencySweepOptions options = testing::between(0.15, 0.2);
  return stopped_oscillator().sweep(options);
}

std::vector<std::vector<CurvePlace>> places_of(const FrequencySweep& curve) {
  std::vector<std::vector<CurvePlace>> places;
  for (const SweepPoint& point : curve.points) places.push_back({{point.frequency, point.unknown}});
  return places;
}

TEST(ExactAlong, AreThoseOfEachResponseOnAnyNumberOfThreads) {
  const FrequencySweep curve = curve_of_oscillator();
  ASSERT_GT(curve.points.size(), 12u);
  const ExactAlongCurve one = exact_along(stopped_oscillator, curve, places_of(curve), {.threads = 1}),
                        three = exact_along(stopped_oscillator, curve, places_of(curve), {.threads = 3});
  ASSERT_EQ(one.points.size(), curve.points.size());
  ASSERT_EQ(three.points.size(), curve.points.size());
  ContactProblem problem = stopped_oscillator();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const SweepPoint& point = curve.points[i];
    const PeriodicResponse response = problem.response(curve, point.frequency, point.unknown);
    const ExactNearResponse found = problem.exact_near(response).value();
    ASSERT_TRUE(one.points[i] && three.points[i]);
    EXPECT_EQ(one.points[i]->status, found.motion.status);
    EXPECT_EQ(one.points[i]->displacement_error, found.displacement_error);
    EXPECT_EQ(three.points[i]->displacement_error, found.displacement_error);
    if (!found.motion.converged()) continue;
    EXPECT_EQ(one.points[i]->stability->unstable, problem.stability(response, &found.motion).unstable);
    EXPECT_TRUE(one.points[i]->stability->is_exact);
  }
}

// No motion of another frequency is near, so that the second solution is taken.
TEST(ExactAlong, TryOneSolutionAfterAnother) {
  const FrequencySweep curve = curve_of_oscillator();
  const SweepPoint &point = curve.points.front(), &other = curve.points.back();
  const CurvePlace wrong{0.5 * point.frequency, point.unknown}, right{other.frequency, other.unknown};
  ExactAlongOptions options;
  options.max_distance = 1e-2;
  const ExactAlongCurve found = exact_along(stopped_oscillator, curve, {{wrong, right}, {wrong}}, options);
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_EQ(found.points[0]->status, ExactStatus::converged);
  EXPECT_EQ(found.points[0]->place, 1u);
  EXPECT_EQ(found.points[1]->status, ExactStatus::not_found);
  EXPECT_TRUE(std::isnan(found.points[1]->displacement_error));
  EXPECT_FALSE(found.points[1]->stability);
}

TEST(ExactAlong, AreNotThoseOfAMotionFartherAwayThanAllowed) {
  const FrequencySweep curve = curve_of_oscillator();
  const SweepPoint& point = curve.points.back();
  ContactProblem problem = stopped_oscillator();
  const PeriodicResponse response = problem.response(curve, point.frequency, point.unknown);
  const ExactNearResponse found = problem.exact_near(response).value();
  ASSERT_EQ(found.motion.status, ExactStatus::converged);
  ExactAlongOptions options;
  options.max_distance = 0.5 * found.displacement_error;
  const ExactNearResponse none = exact_near(problem, response, options).value();
  EXPECT_EQ(none.motion.status, ExactStatus::not_found);
  EXPECT_TRUE(std::isnan(none.displacement_error) && std::isnan(none.force_error));
  options.max_distance = 2.0 * found.displacement_error;
  EXPECT_EQ(exact_near(problem, response, options)->motion.status, ExactStatus::converged);
}

TEST(ExactAlong, StopWhereTheObserverSaysSo) {
  const FrequencySweep curve = curve_of_oscillator();
  ExactAlongOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 3; };
  const ExactAlongCurve found = exact_along(stopped_oscillator, curve, places_of(curve), options);
  EXPECT_TRUE(found.cancelled);
  EXPECT_TRUE(found.points[2]);
  EXPECT_FALSE(found.points[3]);
}

TEST(ExactAlong, RefuseOptionsOutOfRange) {
  const FrequencySweep curve = curve_of_oscillator();
  EXPECT_THROW(exact_along(stopped_oscillator, curve, places_of(curve), {.max_distance = 0.0}),
               std::invalid_argument);
  EXPECT_THROW(exact_along(stopped_oscillator, curve, places_of(curve), {.threads = -1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers
