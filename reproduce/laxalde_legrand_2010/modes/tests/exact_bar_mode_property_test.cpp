#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "bar_quadrature.hpp"
#include "constants.hpp"
#include "random_values.hpp"

namespace wavebalance::ll10 {
namespace {

int any_count(int least, int greatest) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(least, greatest + 1));
}

RC_GTEST_PROP(ExactBarModeProperty, MeetsRigidContactForAnyBarModeAndEnergy, ()) {
  const RigidObstacleBar bar{std::pow(10.0, any_between(-3, 12)), std::pow(10.0, any_between(-3, 5)),
                             std::pow(10.0, any_between(-6, 1)), std::pow(10.0, any_between(-2, 2)),
                             std::pow(10.0, any_between(-6, 0))};
  const auto measure =
      *rc::gen::element(EnergyMeasure::total, EnergyMeasure::mean_kinetic, EnergyMeasure::modal);
  const int m = any_count(1, 12);
  const double energy = ExactBarMode::onset_energy(m, measure) + std::pow(10.0, any_between(-4, 8));
  const ExactBarMode mode = ExactBarMode::at_energy(bar, m, measure, energy);
  RC_ASSERT(std::abs(mode.energy_ratio(measure) / energy - 1.0) <= 16 * eps);
  for (int i = 0; i < 200; ++i) {
    const double t = any_between(-3, 3) * mode.period();
    const double g = mode.displacement(bar.length, t) - bar.gap, force = mode.contact_force(t);
    const double rounding = 256 * eps * reach(mode);
    RC_ASSERT(mode.displacement(0.0, t) == 0.0 && mode.velocity(0.0, t) == 0.0);
    RC_ASSERT(g <= rounding);
    RC_ASSERT(force >= 0.0);
    RC_ASSERT(force * std::abs(g) <= mode.contact_force(0.0) * rounding);
    const double strain = mode.strain(bar.length, t) * bar.youngs_modulus * bar.area;
    RC_ASSERT(std::abs(strain + force) <= 4 * eps * force);
  }
}

}  // namespace
}  // namespace wavebalance::ll10
