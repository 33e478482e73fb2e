// Curves that are followed together, and how far they are apart.
#include "wavebalance/app/compare/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/bar_scene.hpp"
#include "support/brief_comparison.hpp"

namespace wavebalance::app {
namespace {

// Few elements, because the exact curve is slowest.
const std::vector<std::string> brief_sweep{"structure.elements=5",        "analysis.type=frequency_sweep",
                                           "analysis.frequency_from=100", "analysis.frequency_to=160",
                                           "time.functions=16",           "time.quadrature_points=64"};

void expect_same_curve(const ComparedCurve& found, const ComparedCurve& expected) {
  EXPECT_EQ(found.pair, expected.pair);
  EXPECT_EQ(found.functions, expected.functions);
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.varied, expected.varied);
  EXPECT_EQ(found.displacement, expected.displacement);
  EXPECT_EQ(found.turning_points, expected.turning_points);
  EXPECT_EQ(found.distance, expected.distance);
  EXPECT_GT(found.seconds, 0.0);
}

TEST(SweepComparison, OnSeveralThreadsHasTheCurvesOfOneToTheLastDigit) {
  ComparisonOptions options = brief(600.0);
  options.pairs.push_back({"haar", "fourier"});
  options.largest_functions = 64;
  options.threads = 1;
  const SweepComparison expected = compare_sweeps(scene_of(brief_sweep), options);
  ASSERT_EQ(expected.curves.size(), 12u);
  EXPECT_GE(std::count_if(expected.curves.begin(), expected.curves.end(),
                          [](const ComparedCurve& curve) { return curve.converged(); }),
            9);
  for (const int threads : {2, 5, 0}) {
    options.threads = threads;
    std::atomic<int> inside{0}, together{0};
    const SweepComparison found = compare_sweeps(scene_of(brief_sweep), options, [&](const Progress&) {
      if (++inside > 1) ++together;
      --inside;
      return true;
    });
    EXPECT_EQ(together, 0) << threads;
    ASSERT_EQ(found.curves.size(), expected.curves.size()) << threads;
    for (std::size_t i = 0; i < expected.curves.size(); ++i)
      expect_same_curve(found.curves[i], expected.curves[i]);
    EXPECT_EQ(found.finest, expected.finest);
    EXPECT_EQ(found.status(), "converged");
  }
}

TEST(SweepComparison, OnTwoThreadsThatIsInterruptedHoldsWhatWasMeasuredSoFar) {
  ComparisonOptions options = brief(600.0);
  options.threads = 2;
  int calls_after = 0;
  bool stopped = false;
  const SweepComparison found = compare_sweeps(scene_of(brief_sweep), options, [&](const Progress& progress) {
    calls_after += stopped ? 1 : 0;
    stopped = stopped || progress.step >= 4;
    return !stopped;
  });
  EXPECT_EQ(calls_after, 0);
  EXPECT_TRUE(found.interrupted);
  EXPECT_EQ(found.status(), "interrupted");
  EXPECT_GE(found.curves.size(), 4u);
  EXPECT_LE(found.curves.size(), 6u);  // runs of both threads were under way
  EXPECT_TRUE(found.curves.front().converged());
}

TEST(SweepComparison, OnTwoThreadsCarriesAnExceptionOfItsObserverToTheCaller) {
  ComparisonOptions options = brief(600.0);
  options.threads = 2;
  const auto observer = [](const Progress& progress) -> bool {
    if (progress.step >= 3) throw std::runtime_error("of the observer");
    return true;
  };
  EXPECT_THROW(compare_sweeps(scene_of(brief_sweep), options, observer), std::runtime_error);
}

TEST(SweepComparison, MeasuresTheLargestDistanceBothWaysInUnitsOfTheWindow) {
  ComparedCurve a, b;
  a.varied = {0.0, 10.0};
  a.displacement = {1.0, 1.0};
  b.varied = {0.0, 5.0, 10.0};
  b.displacement = {1.0, 2.0, 1.0};  // its height is 2
  EXPECT_NEAR(curve_distance(a, b, 10.0), 0.5, 1e-12);
  EXPECT_NEAR(curve_distance(b, b, 10.0), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(curve_distance(a, ComparedCurve{}, 10.0)));
}

}  // namespace
}  // namespace wavebalance::app
