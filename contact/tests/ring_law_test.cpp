#include "wavebalance/contact/ring_law.hpp"

#include <array>

#include "testing.hpp"

namespace wavebalance::contact {
namespace {

using Pair = std::array<double, 2>;
using Slopes = std::array<double, 4>;

Pair force_at(const RingLaw& law, const Pair& u) {
  Pair force{};
  Slopes slopes{};
  law.closed(u, force, slopes);
  return force;
}

TEST(RingLaw, PressesAlongTheRadiusAndRubsAgainstTheSurfaceThatTurnsFromXToY) {
  const RingLaw law(5.0, 1.0, 0.3);
  for (const double angle : {0.2, 1.9, -2.4}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const Pair force = force_at(law, {1.4 * c, 1.4 * s});
    EXPECT_NEAR(c * force[0] + s * force[1], 2.0, 1e-14);
    EXPECT_NEAR(-s * force[0] + c * force[1], 0.6, 1e-14);  // forces oppose positive displacements
  }
}

TEST(RingLaw, TouchesAtItsClearanceAlongEveryRadius) {
  const RingLaw law(5.0, 0.25);
  for (const double angle : {0.2, 1.9, -2.4}) {
    const Pair at{0.25 * std::cos(angle), 0.25 * std::sin(angle)};
    Pair slopes{};
    EXPECT_NEAR(law.penetration(at, slopes), 0.0, 1e-16);
    EXPECT_NEAR(slopes[0] * at[0] + slopes[1] * at[1], 0.25, 1e-16);  // as r - gap along the radius
    EXPECT_NEAR(force_at(law, at)[0], 0.0, 1e-15);
  }
  Pair slopes{};
  EXPECT_EQ(law.penetration(Pair{0.0, 0.0}, slopes), -0.125);
}

TEST(RingLaw, SlopesAreTheDerivatives) {
  constexpr double h = 1e-6;
  for (const double friction : {0.0, -0.4}) {
    const RingLaw law(5.0, 1.0, friction);
    for (const Pair& u : {Pair{1.2, 0.3}, Pair{-0.4, -1.7}}) {
      Pair force{}, by{};
      Slopes slopes{};
      law.closed(u, force, slopes);
      law.penetration(u, by);
      for (std::size_t j = 0; j < 2; ++j) {
        Pair up = u, down = u, none{};
        up[j] += h;
        down[j] -= h;
        const Pair more = force_at(law, up), less = force_at(law, down);
        for (std::size_t i = 0; i < 2; ++i)
          EXPECT_NEAR((more[i] - less[i]) / (2.0 * h), slopes[2 * i + j], 1e-8);
        EXPECT_NEAR((law.penetration(up, none) - law.penetration(down, none)) / (2.0 * h), by[j], 1e-8);
        if (friction == 0.0) {
          EXPECT_NEAR((law.potential(up) - law.potential(down)) / (2.0 * h), force[j], 1e-8);
        }
      }
    }
  }
}

TEST(RingLaw, RefusesParametersOutOfRange) {
  EXPECT_THROW(RingLaw(0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(RingLaw(1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(RingLaw(1.0, 1.0, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::contact
