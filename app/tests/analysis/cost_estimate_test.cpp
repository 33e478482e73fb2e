#include "wavebalance/app/analysis/cost_estimate.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "support/bar_scene.hpp"

namespace {

using namespace wavebalance::app;

TEST(EstimateCost, GrowsWithEachSizeByItsShare) {
  const Scene scene = scene_of();
  const auto bytes = [&](const std::vector<std::string>& overrides) {
    return estimate_cost(scene_of(overrides)).bytes;
  };
  const double base = bytes({});
  EXPECT_GT(base, 10e6);
  EXPECT_LT(base, 100e6);
  EXPECT_NEAR(bytes({"analysis.output_points=1048576"}) - base, 500.0 * (1048576 - 1024), 1e-6 * base);
  EXPECT_GT(bytes({"time.quadrature_points=16777216"}), 130.0 * 16777216);
  EXPECT_LT(bytes({"time.functions=64", "time.quadrature_points=16777216"}), 200.0 * 16777216);
  EXPECT_GT(bytes({"time.functions=1048576", "time.quadrature_points=1048576"}), 280.0 * 1048576);
  EXPECT_GT(estimate_cost(scene_of({"time.functions=1048576", "time.quadrature_points=1048576"})).seconds,
            100.0 * estimate_cost(scene).seconds);
  EXPECT_TRUE(std::isnan(estimate_cost(scene_of({"analysis.type=time_stepping"})).seconds));
}

TEST(EstimateCost, OfALawOfTheVelocityIsThatOfOthersSinceNoMatrixOfAllItsSamplesIsFormed) {
  Scene scene = scene_of({"time.quadrature_points=16384", "time.functions=16383"});
  const double of_displacement = estimate_cost(scene).bytes;
  scene.contact.law = "hunt_crossley";
  scene.contact.values = {{"hertz_stiffness", 1e9}, {"dissipation", 0.0}};
  EXPECT_EQ(estimate_cost(scene).bytes, of_displacement);
}

TEST(CostText, SaysSecondsAndMemory) {
  EXPECT_EQ(cost_text({.seconds = 0.2, .bytes = 21e6}), "about 200 ms and 21 MB of memory");
}

TEST(CostText, GivesTheExactMotionOfAResponseARange) {
  EXPECT_EQ(
      cost_text({.seconds = 0.2, .least_exact_seconds = 0.5, .most_exact_seconds = 24.0, .bytes = 21e6}),
      "about 200 ms for the response, 500 ms to 24 s for its exact motion, and 21 MB of memory");
}

TEST(AvailableMemory, IsThatOfTheMachineAtMost) {
  EXPECT_GT(available_memory(), 1e6);
  EXPECT_LE(available_memory(),
            static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE)));
  EXPECT_EQ(memory_text(1.234e9), "1.2 GB");
  EXPECT_EQ(memory_text(15.2e6), "15 MB");
}

}  // namespace
