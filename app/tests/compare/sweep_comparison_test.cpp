#include "wavebalance/app/compare/sweep_comparison.hpp"
#include "wavebalance/app/analysis/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "support/bar_scene.hpp"
#include "support/brief_comparison.hpp"
#include "support/curve_record.hpp"
#include "wavebalance/app/compare/comparison_record.hpp"

namespace wavebalance::app {
namespace {

// Few elements, since the exact curve takes longest.
const std::vector<std::string> brief_sweep{"structure.elements=5",        "analysis.type=frequency_sweep",
                                           "analysis.frequency_from=100", "analysis.frequency_to=160",
                                           "time.functions=16",           "time.quadrature_points=64"};

TEST(SweepComparison, LaysCurvesOfSeveralPairsOverTheFinest) {
  ComparisonOptions options = brief(20.0);
  options.largest_functions = 64;
  options.threads = 1;  // one curve ends after the other
  const std::vector<std::string>& sweep = brief_sweep;
  // Time for a few sizes only.
  int most = 0;
  const SweepComparison found = compare_sweeps(scene_of(sweep), options, [&](const Progress& progress) {
    most = progress.step;
    return progress.step < 6;
  });
  EXPECT_EQ(most, 6);
  EXPECT_TRUE(found.interrupted);
  ASSERT_GE(found.curves.size(), 6u);
  ASSERT_TRUE(found.finest);
  const ComparedCurve& finest = found.curves[*found.finest];
  EXPECT_EQ(finest.functions, 31);
  EXPECT_EQ(finest.points, 128);
  EXPECT_EQ(finest.distance, 0.0);
  const ComparedCurve& coarse = found.curves.front();
  EXPECT_TRUE(coarse.converged());
  EXPECT_GT(coarse.distance, 0.0);
  EXPECT_LT(coarse.distance, 0.1);
  EXPECT_NEAR(coarse.peak, finest.peak, 0.1 * finest.peak);
  // The exact curve has the errors of all, which fall with the size.
  ASSERT_TRUE(found.exact);
  EXPECT_NEAR(found.exact->peak, finest.peak, 0.01 * finest.peak);
  EXPECT_GT(coarse.distance_from_exact, finest.distance_from_exact);
  EXPECT_GT(finest.distance_from_exact, 0.0);
  EXPECT_LT(finest.distance_from_exact, 0.02);
  EXPECT_GE(finest.peak_at, 100.0);
  EXPECT_LE(finest.peak_at, 160.0);
}

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
  EXPECT_LE(found.curves.size(), 6u);  // those of both threads were under way
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

TEST(SweepComparison, OverTheAmplitudeFollowsTheCurveOfThatSweep) {
  ComparisonOptions options = brief(20.0);
  options.pairs = {{"fourier", "fourier"}};
  options.largest_functions = 32;
  const Scene scene = load_with({"time.functions=32", "time.quadrature_points=512"});
  const SweepComparison found = compare_sweeps(scene, options);
  ASSERT_TRUE(found.converged()) << found.status();
  EXPECT_EQ(found.peak_column, "amplitude_at_max_displacement_N");
  const ComparedCurve& finest = found.curves[*found.finest];
  const Sweep alone = amplitude_sweep(load_with({"time.functions=31", "time.quadrature_points=512"}));
  ASSERT_EQ(finest.varied.size(), alone.curve.points.size());
  for (std::size_t i = 0; i < finest.varied.size(); ++i) {
    EXPECT_EQ(finest.varied[i], alone.curve.points[i].load_scale);
    EXPECT_EQ(finest.displacement[i], alone.curve.points[i].max_displacement);
  }
  EXPECT_EQ(finest.turning_points, 2);
  EXPECT_GT(found.curves.front().distance, 0.0);
  const ComparisonRecord record = comparison_record(scene, found);
  EXPECT_TRUE(record.table.has_column("amplitude_at_max_displacement_N"));
  EXPECT_NE(record.text.find(" N, and it turns 2 times"), std::string::npos) << record.text;
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
