#include "wavebalance/app/analysis/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/bar_scene.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::app {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(ObservedOrder, OfAPowerLawIsItsExponent) {
  const std::vector<double> sizes{8, 16, 32, 64};
  std::vector<double> errors;
  for (const double size : sizes) errors.push_back(7.0 * std::pow(size, -3.0));
  EXPECT_NEAR(observed_order(sizes, errors), 3.0, 100 * eps);
  errors[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(observed_order(sizes, errors), std::invalid_argument);
  EXPECT_THROW(observed_order(sizes, std::vector<double>{1.0}), std::invalid_argument);
}

TEST(EnergyNorm, IsTheOscillatorsEnergyWithoutContact) {
  // An undamped oscillator far below resonance: u = F/(k - m w^2) cos wt, E = (k cos^2 + m w^2 sin^2) u_max^2
  // / 2.
  const Scene scene =
      parse_scene(with(with(with(with(bar_scene, "\"exponential\"", "\"none\""), "constant = 1e8", ""),
                            "exponent = 50.0", ""),
                       "gap = 1e-3", ""),
                  "case.toml", {{"structure.elements=1", "structure.stiffness_damping=0"}});
  const auto& bar = scene.structure;
  const double k = bar.youngs_modulus * bar.area / bar.length;
  const double m = bar.density * bar.area * bar.length / 3.0;
  const double w = 2.0 * std::acos(-1.0) * scene.forcing.frequency;
  const double peak = scene.forcing.amplitude / (k - m * w * w);
  const double a = k * peak * peak / 2, b = m * w * w * peak * peak / 2;
  const auto response =
      weighted_residual_response(scene, {.structure_points = 1024, .guess = {}, .observer = {}});
  EXPECT_NEAR(energy_norm(scene, response.structure), std::sqrt((3 * a * a + 2 * a * b + 3 * b * b) / 8),
              1e-9 * a);
}

TEST(EnergyNorm, NeedsTheFullHistory) {
  const Scene scene = scene_of();
  EXPECT_THROW(energy_norm(scene, weighted_residual_response(scene).structure), std::invalid_argument);
}

TEST(RelativeRmsError, IsRelativeToTheReference) {
  const Eigen::VectorXd reference = Eigen::VectorXd::LinSpaced(10, 1.0, 2.0);
  EXPECT_DOUBLE_EQ(relative_rms_error(1.5 * reference, reference), 0.5);
  EXPECT_THROW(relative_rms_error(reference.head(3), reference), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::app
