#include <rapidcheck/gtest.h>

#include "random_values.hpp"
#include "testing.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/contact/kelvin_voigt_law.hpp"

namespace wavebalance::contact {
namespace {

HuntCrossleyLaw any_hunt_crossley_law() {
  return {std::pow(10.0, any_between(0, 4)), any_between(1, 2.5), any_between(0, 1), any_between(-1, 1)};
}
KelvinVoigtLaw any_kelvin_voigt_law() {
  return {std::pow(10.0, any_between(0, 3)), std::pow(10.0, any_between(-1, 2)), any_between(-1, 1),
          any_between(0, 0.3)};
}

// Central differences where the force is smooth about the point.
template <class Law>
void check_slopes(const Law& law) {
  const double step = 1e-6, u = law.gap() + any_between(0.01, 1), v = any_between(-3, 3);
  for (const double du : {-step, step})
    for (const double dv : {-step, step}) RC_PRE(law.force(u + du, v + dv) > 0.0);
  const double size = law.force(u, v) + std::abs(law.tangent(u, v)) + law.damping(u, v);
  RC_ASSERT(std::abs((law.force(u + step, v) - law.force(u - step, v)) / (2 * step) - law.tangent(u, v)) <=
            1e-3 * size);
  RC_ASSERT(std::abs((law.force(u, v + step) - law.force(u, v - step)) / (2 * step) - law.damping(u, v)) <=
            1e-6 * size);
  RC_ASSERT(std::abs((law.potential(u + step) - law.potential(u - step)) / (2 * step) - law.force(u, 0.0)) <=
            1e-6 * size);
}

RC_GTEST_PROP(DampedLawProperty, HuntCrossleySlopesAreTheDerivatives, ()) {
  check_slopes(any_hunt_crossley_law());
}
RC_GTEST_PROP(DampedLawProperty, KelvinVoigtSlopesAreTheDerivatives, ()) {
  check_slopes(any_kelvin_voigt_law());
}

template <class Law>
void check_no_tension_and_dissipation(const Law& law) {
  const double u = law.gap() + any_between(-1, 1), v = any_between(-10, 10);
  const auto at = law.evaluate(u, v);
  RC_ASSERT(at.force >= 0.0);
  RC_ASSERT(at.damping >= 0.0);
  if (u <= law.gap()) RC_ASSERT(at.force == 0.0);
  // The part beyond the elastic force works against the velocity.
  RC_ASSERT((at.force - law.force(u, 0.0)) * v >= 0.0);
  RC_ASSERT(at.force == law.force(u, v));
}

RC_GTEST_PROP(DampedLawProperty, HuntCrossleyNeverPullsNorAddsEnergy, ()) {
  check_no_tension_and_dissipation(any_hunt_crossley_law());
}
RC_GTEST_PROP(DampedLawProperty, KelvinVoigtNeverPullsNorAddsEnergy, ()) {
  check_no_tension_and_dissipation(any_kelvin_voigt_law());
}

TEST(DampedLaw, HasTheForcesOfItsFormula) {
  const HuntCrossleyLaw hertz(8.0, 1.5, 0.25, 1.0);
  EXPECT_DOUBLE_EQ(hertz.force(5.0, 2.0), 8.0 * 8.0 * 1.5);
  EXPECT_EQ(hertz.force(5.0, -4.0), 0.0);
  const KelvinVoigtLaw damper(10.0, 3.0, 1.0);
  EXPECT_DOUBLE_EQ(damper.force(1.5, 2.0), 11.0);
  EXPECT_EQ(damper.force(1.5, -2.0), 0.0);
  EXPECT_EQ(damper.force(1.0, 2.0), 0.0);
  const KelvinVoigtLaw gentle(10.0, 3.0, 1.0, 1.0);
  EXPECT_DOUBLE_EQ(gentle.force(1.5, 2.0), 5.0 + 3.0 * 0.5 * 2.0);  // s(1/2) = 1/2
}

// A mass that strikes with a small velocity v leaves with 1 - 2/3 c v of it [Hunt, Crossley].
TEST(DampedLaw, HuntCrossleyHasTheRestitutionOfItsPublication) {
  const double c = 0.05, strike = 0.1;
  const HuntCrossleyLaw law(1e4, 1.5, c, 0.0);
  double u = 1e-12, v = strike;
  const double step = 2e-6;
  const auto rate = [&](double at, double speed) { return -law.force(at, speed); };
  while (u > 0.0) {
    const double k1 = rate(u, v), k2 = rate(u + 0.5 * step * v, v + 0.5 * step * k1);
    const double k3 = rate(u + 0.5 * step * (v + 0.5 * step * k1), v + 0.5 * step * k2);
    const double k4 = rate(u + step * (v + 0.5 * step * k2), v + step * k3);
    u += step * v + step * step / 6.0 * (k1 + k2 + k3);
    v += step / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  EXPECT_NEAR(-v / strike, 1.0 - 2.0 / 3.0 * c * strike, 2e-5);
}

TEST(DampedLaw, NamesTheConstantThatIsWrong) {
  EXPECT_THROW(HuntCrossleyLaw(1.0, 0.5, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(HuntCrossleyLaw(0.0, 1.5, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(HuntCrossleyLaw(1.0, 1.5, -0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(KelvinVoigtLaw(1.0, -1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(KelvinVoigtLaw(1.0, 1.0, 0.0, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::contact
