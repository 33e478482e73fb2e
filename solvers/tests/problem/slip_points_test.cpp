// Where contacts begin to slip along sweeps, against the closed form of the response with the slider stuck.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {
namespace {

// Slip begins at the load whose linear response with the slider stuck reaches the limit: F = (L / k_t) |k +
// k_t - omega^2 + i c omega|.
TEST(SlipPoints, AreAtTheExactLoadOfAnAmplitudeSweep) {
  for (const double omega : {0.45, 1.2, 1.41}) {
    const double exact = std::abs(std::complex<double>(2.0 - omega * omega, 0.05 * omega));
    const testing::FrictionScene scene = testing::slider_on_oscillator(1.0, 1.0, omega);
    ContactProblem problem({testing::fourier_pair(31, 128), scene.structure, testing::cosine_load()},
                           scene.contact_laws());
    FrequencySweepOptions options;
    options.from = 0.3 * exact;
    options.to = 1.7 * exact;
    options.keep_unknowns = true;
    const FrequencySweep curve = problem.amplitude_sweep(scene.frequency(), options);
    ASSERT_EQ(curve.status, SweepStatus::reached_end);
    const CurveStability stability = problem.stability(curve);
    std::vector<SpecialPoint> slips;
    for (const SpecialPoint& point : stability.special_points)
      if (point.type == SpecialPointType::slip) slips.push_back(point);
    ASSERT_EQ(slips.size(), 1U) << omega;
    EXPECT_TRUE(slips[0].located);
    EXPECT_NEAR(slips[0].load_scale, exact, 1e-8 * exact) << omega;
    EXPECT_NEAR(slips[0].max_displacement, 1.0, 1e-4);
  }
}

// Around the resonance of the stuck slider a small load makes it slip between two frequencies.
TEST(SlipPoints, OfAFrequencySweepAreWhereTheStuckResponseReachesTheLimit) {
  constexpr double load = 0.2;
  const testing::FrictionScene scene = testing::slider_on_oscillator(load, 1.0, 1.0);
  ContactProblem problem({testing::fourier_pair(31, 512), scene.structure, testing::cosine_load()},
                         scene.contact_laws());
  FrequencySweepOptions options;
  options.from = 1.2 / (2.0 * std::numbers::pi);
  options.to = 1.65 / (2.0 * std::numbers::pi);
  options.keep_unknowns = true;
  const FrequencySweep curve = problem.sweep(options);
  ASSERT_EQ(curve.status, SweepStatus::reached_end);
  const CurveStability stability = problem.stability(curve);
  std::vector<double> slips;
  for (const SpecialPoint& point : stability.special_points)
    if (point.type == SpecialPointType::slip) slips.push_back(2.0 * std::numbers::pi * point.frequency);
  ASSERT_EQ(slips.size(), 2U);
  for (const double omega : slips)
    EXPECT_NEAR(std::abs(std::complex<double>(2.0 - omega * omega, 0.05 * omega)), load, 1e-8);
}

}  // namespace
}  // namespace wavebalance::solvers
