#include "exact_bar_mode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bar_quadrature.hpp"
#include "constants.hpp"

namespace wavebalance::ll10 {
namespace {

TEST(ExactBarMode, TouchesOnceAPeriodAndNeverPenetrates) {
  for_each_mode([](const ExactBarMode& mode) {
    const double gap = mode.bar().gap, rounding = 64 * eps * reach(mode);
    const int times = 4001;
    for (int i = 0; i < times; ++i) {
      const double t = (double(i) / times - 0.5) * mode.period();
      const double room = gap - mode.displacement(mode.bar().length, t);
      if (std::abs(t) <= 0.5 * mode.contact_duration())
        EXPECT_NEAR(room, 0.0, rounding) << t;
      else
        EXPECT_GT(room, 0.0) << t;
      EXPECT_GE(mode.contact_force(t), 0.0);
      EXPECT_LE(mode.contact_force(t) * std::abs(room), mode.contact_force(0.0) * rounding);
    }
  });
}

// The parallelogram identity of the wave equation holds for any step, fronts included.
TEST(ExactBarMode, SolvesTheWaveEquation) {
  for_each_mode([](const ExactBarMode& mode) {
    const RigidObstacleBar& bar = mode.bar();
    const double speed = std::sqrt(bar.youngs_modulus / bar.density);
    for (double x : {0.21, 0.5, 0.66})
      for (double h : {0.01, 0.1, 0.2})
        for (int i = 0; i < 40; ++i) {
          const double t = (i + 0.3) / 40 * mode.period(), dx = h * bar.length, at = x * bar.length;
          const double in_time =
              mode.displacement(at, t + dx / speed) + mode.displacement(at, t - dx / speed);
          const double in_space = mode.displacement(at + dx, t) + mode.displacement(at - dx, t);
          EXPECT_NEAR(in_time, in_space, 64 * eps * reach(mode));
        }
  });
}

TEST(ExactBarMode, VelocityAndStrainAreTheDerivatives) {
  for_each_mode([](const ExactBarMode& mode) {
    const double length = mode.bar().length, dt = 1e-6 * mode.period(), dx = 1e-6 * length;
    int away_from_fronts = 0;
    for (double x : {0.11, 0.37, 0.81})
      for (int i = 0; i < 50; ++i) {
        const double t = (i + 0.3) / 50 * mode.period(), at = x * length;
        if (mode.velocity(at, t - dt) != mode.velocity(at, t + dt) ||
            mode.strain(at, t - dt) != mode.strain(at, t + dt))
          continue;
        ++away_from_fronts;
        EXPECT_NEAR((mode.displacement(at, t + dt) - mode.displacement(at, t - dt)) / (2 * dt),
                    mode.velocity(at, t), 64 * eps * reach(mode) / dt);
        EXPECT_NEAR((mode.displacement(at + dx, t) - mode.displacement(at - dx, t)) / (2 * dx),
                    mode.strain(at, t), 64 * eps * reach(mode) / dx);
      }
    EXPECT_GT(away_from_fronts, 140);
  });
}

TEST(ExactBarMode, ConservesItsEnergy) {
  for_each_mode([](const ExactBarMode& mode) {
    for (int i = 0; i < 9; ++i) {
      const double t = (i + 0.217) / 9 * mode.period();
      EXPECT_NEAR((kinetic_energy(mode, t) + elastic_energy(mode, t)) / mode.total_energy(), 1.0, 1e-11);
    }
  });
}

// The kinetic energy is piecewise linear in time, so the midpoint rule errs at kinks, by the square of the
// step; intervals narrower than a panel, where two fronts cross, cost as much.
TEST(ExactBarMode, MeanKineticEnergyIsTheQuadratureOverSpaceAndTime) {
  for (int m = 1; m <= 4; ++m)
    for (double fraction : {0.15, 0.5, 0.9}) {
      const ExactBarMode mode = mode_at({}, m, fraction);
      const int times = 300, panels = 300;
      double sum = 0.0;
      for (int i = 0; i < times; ++i) sum += kinetic_energy(mode, (i + 0.5) / times * mode.period(), panels);
      EXPECT_NEAR(sum / times / mode.mean_kinetic_energy(), 1.0, 10.0 / (times * double(times))) << m;
    }
}

// A forward solution from the state of the mode at a quarter period returns to it, touching as the mode does.
TEST(ExactBarMode, IsWhatTheBarDoesWhenLetGoFromItsState) {
  struct Case {
    int mode, cells, steps_a_period;
  };
  for (const Case& c :
       {Case{1, 20, 70}, Case{1, 40, 124}, Case{2, 20, 26}, Case{3, 200, 158}, Case{4, 200, 114}}) {
    const double h = 1.0 / c.cells, period = c.steps_a_period * h;
    const ExactBarMode mode({}, c.mode, 4.0 / ((2 * c.mode - 1) * period));
    const int first = c.steps_a_period / 4;
    std::vector<double> right, left;
    for (int i = 0; i < c.cells; ++i) {
      const double x = (i + 0.5) * h, v = mode.velocity(x, first * h), strain = mode.strain(x, first * h);
      right.push_back(v - strain);
      left.push_back(v + strain);
    }
    CharacteristicBar bar(right, left, mode.displacement(1.0, first * h), 1.0);
    for (int k = first; k < first + 3 * c.steps_a_period; ++k) {
      bar.step();
      EXPECT_NEAR(bar.tip(), mode.displacement(1.0, (k + 1) * h), 1e-9) << c.mode << " " << k;
      EXPECT_NEAR(bar.force(), mode.contact_force((k + 0.5) * h), 1e-9) << c.mode << " " << k;
    }
    for (int i = 0; i < c.cells; ++i) {
      const double x = (i + 0.5) * h;
      EXPECT_NEAR(bar.velocity(i), mode.velocity(x, first * h), 1e-9);
      EXPECT_NEAR(bar.strain(i), mode.strain(x, first * h), 1e-9);
    }
  }
}

// The bar pulled back by (1 - x)/2 from an obstacle that it touches at rest: here x counts from the clamp and
// u towards the obstacle, so u0 = -x/2. Every speed and strain is 0 or 1/2, the period 3.
TEST(ZeroGapMode, IsTheMotionOfABarPulledBackAndLetGo) {
  const ExactBarMode mode = ExactBarMode::zero_gap({}, 1, 0.125);
  EXPECT_EQ(mode.period(), 3.0);
  const int cells = 20;
  const double h = 1.0 / cells, half = 1.5;
  for (double x : {0.0, 0.25, 0.6, 1.0}) {
    EXPECT_NEAR(mode.displacement(x, half), -0.5 * x, 4 * eps);
    EXPECT_EQ(mode.velocity(0.99 * x, half), 0.0);
  }
  CharacteristicBar bar(std::vector<double>(cells, 0.5), std::vector<double>(cells, -0.5), -0.5, 0.0);
  double touching = 0.0;
  for (int k = 0; k < 2 * 60; ++k) {
    bar.step();
    touching += bar.force() > 0.0 ? 0.5 * h : 0.0;  // a period, of two
    EXPECT_NEAR(bar.tip(), mode.displacement(1.0, half + (k + 1) * h), 512 * eps) << k;
    EXPECT_NEAR(bar.force(), mode.contact_force(half + (k + 0.5) * h), 512 * eps) << k;
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) * h, t = half + (k + 1) * h;
      EXPECT_NEAR(bar.velocity(i), mode.velocity(x, t), 512 * eps);
      EXPECT_NEAR(bar.strain(i), mode.strain(x, t), 512 * eps);
      const double speed = std::abs(mode.velocity(x, t)), stretch = std::abs(mode.strain(x, t));
      EXPECT_TRUE((speed == 0.0 && stretch == 0.5) || (speed == 0.5 && stretch == 0.0));
    }
  }
  EXPECT_NEAR(touching, 1.0, 1e-12);
  EXPECT_NEAR(mode.contact_duration(), 1.0, 4 * eps);
}

TEST(ZeroGapMode, IsTheLimitOfHighEnergyAndHasTheEnergyAskedFor) {
  for (int m = 1; m <= 4; ++m) {
    const ExactBarMode mode = ExactBarMode::zero_gap(published_bar(), m, 7.0);
    EXPECT_EQ(mode.bar().gap, 0.0);
    EXPECT_NEAR(mode.total_energy(), 7.0, 32 * eps);
    EXPECT_NEAR((kinetic_energy(mode, 1e-5) + elastic_energy(mode, 1e-5)) / 7.0, 1.0, 1e-11);
    EXPECT_EQ(mode.energy_ratio(EnergyMeasure::total), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(mode.frequency_ratio(), ExactBarMode::largest_frequency_ratio(m), 4 * eps);
    RigidObstacleBar near_bar = published_bar();
    near_bar.gap = 1e-11;
    const ExactBarMode low = mode_at(near_bar, m, 0.5);
    const double grazing = low.total_energy() / low.energy_ratio(EnergyMeasure::total);
    const ExactBarMode near = ExactBarMode::at_energy(near_bar, m, EnergyMeasure::total, 7.0 / grazing);
    EXPECT_NEAR(near.contact_force(0.0) / mode.contact_force(0.0), 1.0, 64 * eps);
    for (double x : {0.2, 0.6, 1.0})
      for (double t : {0.0, 0.11, 0.37, 0.5})
        EXPECT_NEAR(near.displacement(x, t * near.period()), mode.displacement(x, t * mode.period()),
                    1e-6 * reach(mode));
  }
}

}  // namespace
}  // namespace wavebalance::ll10
