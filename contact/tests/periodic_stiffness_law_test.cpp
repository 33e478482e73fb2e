#include "wavebalance/contact/periodic_stiffness_law.hpp"

#include <array>

#include "testing.hpp"

namespace wavebalance::contact {
namespace {

using Pair = std::array<double, 2>;
constexpr double unit = PeriodicStiffnessLaw::signal_unit;

Pair force_at(const PeriodicStiffnessLaw& law, const Pair& rows) {
  Pair force{};
  std::array<double, 4> slopes{};
  law.closed(rows, force, slopes);
  return force;
}

TEST(PeriodicStiffnessLaw, IsASpringOfTheStiffnessThatTheSignalSays) {
  const PeriodicStiffnessLaw law(4.0, 0.5);
  for (const double variation : {-0.5, 0.0, 0.25}) {
    EXPECT_NEAR(force_at(law, {0.7, variation * unit})[0], 4.0 * (1.0 + variation) * 0.2, 1e-15);
    EXPECT_NEAR(force_at(law, {-0.8, variation * unit})[0], -4.0 * (1.0 + variation) * 0.3, 1e-15);
    EXPECT_EQ(force_at(law, {0.7, variation * unit})[1], 0.0);
  }
}

TEST(PeriodicStiffnessLaw, TouchesAtEitherEndOfItsBacklashAndAlwaysWithoutOne) {
  Pair slopes{};
  const PeriodicStiffnessLaw law(4.0, 0.5);
  EXPECT_EQ(law.penetration(Pair{0.5, unit}, slopes), 0.0);
  EXPECT_EQ(slopes[0], 1.0);
  EXPECT_EQ(law.penetration(Pair{-0.5, unit}, slopes), 0.0);
  EXPECT_LT(law.penetration(Pair{0.1, unit}, slopes), 0.0);
  EXPECT_GT(PeriodicStiffnessLaw(4.0).penetration(Pair{0.0, 0.0}, slopes), 0.0);
}

TEST(PeriodicStiffnessLaw, SlopesAreTheDerivativesByTheDisplacementAlone) {
  constexpr double h = 1e-6;
  const PeriodicStiffnessLaw law(4.0, 0.5);
  for (const Pair& rows : {Pair{1.2, 0.3 * unit}, Pair{-0.9, -0.6 * unit}}) {
    Pair force{};
    std::array<double, 4> slopes{};
    law.closed(rows, force, slopes);
    const Pair up{rows[0] + h, rows[1]}, down{rows[0] - h, rows[1]};
    EXPECT_NEAR((force_at(law, up)[0] - force_at(law, down)[0]) / (2.0 * h), slopes[0], 1e-8);
    EXPECT_NEAR((law.potential(up) - law.potential(down)) / (2.0 * h), force[0], 1e-8);
    for (const std::size_t other : {1, 2, 3}) EXPECT_EQ(slopes[other], 0.0);
  }
}

}  // namespace
}  // namespace wavebalance::contact
