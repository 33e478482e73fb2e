#include "exact_bar_mode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "bar_quadrature.hpp"
#include "constants.hpp"

namespace wavebalance::ll10 {
namespace {

constexpr double pi = std::numbers::pi;
constexpr EnergyMeasure measures[] = {EnergyMeasure::total, EnergyMeasure::mean_kinetic,
                                      EnergyMeasure::modal};
TEST(ExactBarMode, HasTheClosedFormsOfTheFirstMode) {
  for (double period : {3.001, 3.1, 3.25, 3.5, 3.75, 3.9, 3.999}) {
    const ExactBarMode mode({}, 1, 4.0 / period);
    const double v = 1.0 / (2 * period - 6), tolerance = 1e-12 * std::max(1.0, 0.01 / (period - 3));
    EXPECT_NEAR(mode.period(), period, 1e-12);
    EXPECT_NEAR(mode.contact_duration(), 4 - period, 1e-12);
    EXPECT_NEAR(mode.contact_force(0.0) / (2 * v), 1.0, tolerance);
    EXPECT_NEAR(mode.total_energy() / (2 * v * v), 1.0, tolerance);
    const double kinetic = v * v * (period - 2) * (6 - period) / period;
    EXPECT_NEAR(mode.mean_kinetic_energy() / kinetic, 1.0, tolerance);
    const double total = 8 / (pi * pi * (period - 3) * (period - 3));
    EXPECT_NEAR(mode.energy_ratio(EnergyMeasure::total) / total, 1.0, tolerance);
    const double modal = 8 * v * v * period * (period - 2) * (6 - period) / (4 * pi * pi);
    EXPECT_NEAR(mode.energy_ratio(EnergyMeasure::modal) / modal, 1.0, tolerance);
    EXPECT_NEAR(mode.energy_ratio(EnergyMeasure::mean_kinetic) / (kinetic / (pi * pi / 32)), 1.0, tolerance);
  }
}

TEST(ExactBarMode, HasTheClosedFormsOfHigherModes) {
  for (int m = 1; m <= 6; ++m)
    for (double fraction : fractions) {
      const ExactBarMode mode = mode_at({}, m, fraction);
      const double period = mode.period(), v = 1.0 / (2 * m * m * period - 4 * m - 2);
      EXPECT_NEAR(mode.contact_duration(), 4 - (2 * m - 1) * period, 1e-12);
      EXPECT_NEAR(mode.contact_force(0.0) / (2 * v), 1.0, 1e-10);
      EXPECT_NEAR(mode.total_energy() / (2 * v * v), 1.0, 1e-10);
    }
}

TEST(ExactBarMode, HasThePublishedTableOfFrequencies) {
  const double table[][3] = {{1.2, 1.0536, 1.0095},
                             {1.8, 1.1026, 1.0337},
                             {3, 1.1540, 1.0739},
                             {5, 1.1946, 1.1162},
                             {10, 1.2358, 1.1687}};
  for (const auto& [energy, frequency, rayleigh] : table) {
    const ExactBarMode mode = ExactBarMode::at_energy(published_bar(), 1, EnergyMeasure::modal, energy);
    EXPECT_NEAR(mode.frequency_ratio(), frequency, 5e-5) << energy;
    EXPECT_NEAR(mode.rayleigh_frequency_ratio(), rayleigh, 5e-5) << energy;
  }
}

// omega^2 = r + <lambda> g0 / m^, with m^ = twice the mean kinetic energy over omega^2.
TEST(ExactBarMode, RayleighQuotientFallsShortByTheWorkOfTheContactForceOnTheGap) {
  for_each_mode([](const ExactBarMode& mode) {
    const double omega = 2 * pi * mode.frequency(), linear = omega / mode.frequency_ratio();
    const double mass = 2 * mode.mean_kinetic_energy() / (omega * omega);
    const double mean_force = mode.contact_force(0.0) * mode.contact_duration() / mode.period();
    const double rayleigh = std::pow(mode.rayleigh_frequency_ratio() * linear, 2);
    EXPECT_NEAR((rayleigh + mean_force * mode.bar().gap / mass) / (omega * omega), 1.0, 1e-12);
  });
}

TEST(ExactBarMode, StartsAtTheLinearFrequencyBelowLinearGrazing) {
  EXPECT_NEAR(ExactBarMode::onset_energy(1, EnergyMeasure::total), 8 / (pi * pi), 4 * eps);
  for (int m = 1; m <= 4; ++m)
    for (EnergyMeasure measure : measures) {
      const double onset = ExactBarMode::onset_energy(m, measure);
      EXPECT_LT(onset, 1.0);
      const ExactBarMode mode = ExactBarMode::at_energy({}, m, measure, onset * (1 + 1e-9));
      EXPECT_NEAR(mode.frequency_ratio(), 1.0, 1e-8);
      EXPECT_LT(mode.contact_duration(), 1e-7);
    }
}

TEST(ExactBarMode, EveryEnergyGrowsWithTheFrequency) {
  for (int m = 1; m <= 5; ++m)
    for (EnergyMeasure measure : measures) {
      double previous = ExactBarMode::onset_energy(m, measure);
      for (int i = 1; i < 400; ++i) {
        const double energy = mode_at({}, m, i / 400.0).energy_ratio(measure);
        EXPECT_GT(energy, previous) << m << " " << i;
        previous = energy;
      }
    }
}

TEST(ExactBarMode, ReturnsFromItsEnergyToItsFrequency) {
  for_each_mode([](const ExactBarMode& mode) {
    for (EnergyMeasure measure : measures) {
      const double energy = mode.energy_ratio(measure);
      const ExactBarMode back = ExactBarMode::at_energy(mode.bar(), mode.mode(), measure, energy);
      EXPECT_NEAR(back.frequency_ratio(), mode.frequency_ratio(), 8 * eps);
      EXPECT_NEAR(back.energy_ratio(measure) / energy, 1.0, 16 * eps);
    }
  });
}

TEST(ExactBarMode, KeepsTheEnergyAtAnySize) {
  for (int m = 1; m <= 4; ++m)
    for (EnergyMeasure measure : measures)
      for (double energy : {1.0, 1.8, 10.0, 1e4, 1e8, 1e12, 1e20, 1e100, 1e300}) {
        const ExactBarMode mode = ExactBarMode::at_energy(published_bar(), m, measure, energy);
        EXPECT_NEAR(mode.energy_ratio(measure) / energy, 1.0, 16 * eps) << m << " " << energy;
        EXPECT_LE(mode.frequency_ratio(), ExactBarMode::largest_frequency_ratio(m) * (1 + 2 * eps));
      }
}

TEST(ExactBarMode, HasThePhysicalEnergyAtHighRatios) {
  const RigidObstacleBar bar = published_bar();
  const double stiffness = bar.youngs_modulus * bar.area / bar.length;
  const double grazing = 0.5 * stiffness * bar.gap * bar.gap * pi * pi / 8;  // of the linear mode
  for (double energy : {1e2, 1e6, 1e12}) {
    const ExactBarMode mode = ExactBarMode::at_energy(bar, 1, EnergyMeasure::total, energy);
    EXPECT_NEAR((kinetic_energy(mode, 1e-4) + elastic_energy(mode, 1e-4)) / (energy * grazing), 1.0, 1e-11);
    EXPECT_NEAR(mode.displacement(bar.length, 0.0), bar.gap, 16 * eps * reach(mode));
    // T - 3 = sqrt(8/E)/pi, which the period can show to its own rounding only.
    const double period = mode.period() * std::sqrt(bar.youngs_modulus / bar.density) / bar.length;
    EXPECT_NEAR(period - 3, std::sqrt(8 / energy) / pi, 8 * eps);
  }
}

TEST(ExactBarMode, IsInTheUnitsOfTheBar) {
  const RigidObstacleBar bar = published_bar();
  const double speed = std::sqrt(2.1e11 / 7800.0);
  EXPECT_NEAR(ExactBarMode::linear_frequency(bar, 1), speed / 4, 1e-10);
  EXPECT_NEAR(ExactBarMode::linear_frequency(bar, 1), 1297.186, 1e-3);  // 20 elements: 1297.5197
  EXPECT_NEAR(ExactBarMode::linear_frequency(bar, 3), 5 * speed / 4, 1e-9);
  const RigidObstacleBar other{3.0, 12.0, 0.5, 2.0, 0.25};  // c = 1/2, a length needs 4 s
  for (int m = 1; m <= 3; ++m) {
    const ExactBarMode unit = mode_at({}, m, 0.4), mode = mode_at(other, m, 0.4);
    EXPECT_NEAR(mode.frequency(), mode.frequency_ratio() * ExactBarMode::linear_frequency(other, m),
                64 * eps);
    EXPECT_NEAR(mode.period(), 4 * unit.period(), 32 * eps);
    EXPECT_NEAR(mode.contact_duration(), 4 * unit.contact_duration(), 32 * eps);
    EXPECT_NEAR(mode.displacement(1.4, 3.1), 0.25 * unit.displacement(0.7, 0.775), 64 * eps * reach(mode));
    EXPECT_NEAR(mode.velocity(1.4, 3.1), 0.0625 * unit.velocity(0.7, 0.775), 64 * eps * reach(mode));
    EXPECT_NEAR(mode.contact_force(0.0), 0.1875 * unit.contact_force(0.0), 64 * eps * reach(mode));
    EXPECT_NEAR(mode.total_energy() / (0.046875 * unit.total_energy()), 1.0, 16 * eps);
    for (EnergyMeasure measure : measures)
      EXPECT_NEAR(mode.energy_ratio(measure) / unit.energy_ratio(measure), 1.0, 16 * eps);
  }
}

std::string message_of(const auto& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(ExactBarMode, SaysWhatIsWrongAndWhatIsAllowed) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (double ratio : {1.0, 0.5, 4.0 / 3, 2.0, -1.1, nan, infinity})
    EXPECT_THROW(ExactBarMode({}, 1, ratio), std::invalid_argument) << ratio;
  EXPECT_EQ(
      message_of([] { ExactBarMode({}, 1, 1.5); }),
      "ExactBarMode: frequency_ratio is 1.5; it must be above 1 and below 1.3333333333333333 for mode 1");
  EXPECT_EQ(message_of([] { ExactBarMode({}, 0, 1.1); }), "ExactBarMode: mode is 0; it must be at least 1");
  for (double energy : {0.0, -1.0, 0.81, nan, infinity})
    EXPECT_THROW(ExactBarMode::at_energy({}, 1, EnergyMeasure::total, energy), std::invalid_argument);
  const std::string message = message_of([] { ExactBarMode::at_energy({}, 1, EnergyMeasure::total, 0.5); });
  EXPECT_NE(message.find("energy_ratio is 0.5; it must be above 0.8105694691387"), std::string::npos)
      << message;
  EXPECT_THROW(ExactBarMode::onset_energy(-1, EnergyMeasure::total), std::invalid_argument);
  EXPECT_THROW(ExactBarMode::largest_frequency_ratio(0), std::invalid_argument);
  EXPECT_THROW(ExactBarMode::linear_frequency({}, 0), std::invalid_argument);
  for (double energy : {0.0, -1.0, nan, infinity})
    EXPECT_THROW(ExactBarMode::zero_gap({}, 1, energy), std::invalid_argument);
}

TEST(ExactBarMode, RejectsABarThatIsNone) {
  for (double value :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (auto member : {&RigidObstacleBar::youngs_modulus, &RigidObstacleBar::density,
                        &RigidObstacleBar::area, &RigidObstacleBar::length, &RigidObstacleBar::gap}) {
      RigidObstacleBar bar;
      bar.*member = value;
      EXPECT_THROW(ExactBarMode(bar, 1, 1.1), std::invalid_argument);
      EXPECT_THROW(ExactBarMode::at_energy(bar, 1, EnergyMeasure::total, 2.0), std::invalid_argument);
      if (member != &RigidObstacleBar::gap) {
        EXPECT_THROW(ExactBarMode::zero_gap(bar, 1, 1.0), std::invalid_argument);
      }
    }
}

TEST(ExactBarMode, RejectsPointsOutsideTheBarAndPassesOnWhatIsNotANumber) {
  const ExactBarMode mode(published_bar(), 1, 1.1);
  for (double x : {-1e-3, 1.001, 7.0}) {
    EXPECT_THROW(mode.displacement(x, 0.0), std::invalid_argument);
    EXPECT_THROW(mode.velocity(x, 0.0), std::invalid_argument);
    EXPECT_THROW(mode.strain(x, 0.0), std::invalid_argument);
  }
  EXPECT_EQ(mode.displacement(1.0 + 4 * eps, 0.0), mode.displacement(1.0, 0.0));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(mode.displacement(nan, 0.0)) && std::isnan(mode.displacement(0.5, nan)));
  EXPECT_TRUE(std::isnan(mode.velocity(nan, 0.0)) && std::isnan(mode.strain(0.5, nan)));
  EXPECT_TRUE(std::isnan(mode.contact_force(nan)));
}

}  // namespace
}  // namespace wavebalance::ll10
