#include <rapidcheck/gtest.h>
#include <array>

#include "laws_under_test.hpp"
#include "random_values.hpp"
#include "testing.hpp"

namespace wavebalance::contact {
namespace {

ExponentialLaw any_exponential_law() {
  return {std::pow(10.0, any_between(-3, 9)), std::pow(10.0, any_between(-2, 5)), any_between(-1, 1)};
}

LinearLaw any_linear_law() { return {std::pow(10.0, any_between(-3, 14)), any_between(-1, 1)}; }

// A displacement from free flight to deep contact; alpha (u - g0) up to twice where the force becomes linear.
double any_displacement(const ExponentialLaw& law) {
  return law.gap() + any_between(-1, 2) * *rc::gen::element(1e-6, 1e-3, 1.0) * ExponentialLaw::linear_beyond /
                         law.exponent();
}
double any_displacement(const LinearLaw& law) { return law.gap() + any_between(-1, 2); }

template <class Law>
void check_monotone_and_convex(const Law& law) {
  std::array<double, 3> u{any_displacement(law), any_displacement(law), any_displacement(law)};
  std::sort(u.begin(), u.end());
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    RC_ASSERT(law.force(u[i]) <= law.force(u[i + 1]));
    RC_ASSERT(law.tangent(u[i]) <= law.tangent(u[i + 1]));
    RC_ASSERT(law.potential(u[i]) <= law.potential(u[i + 1]));
    // The chord of a convex function has a slope between the tangents at its ends, whatever lies between.
    const double step = u[i + 1] - u[i];
    const double slack = 1.0 + 1e-9;
    const double rounding = 8 * eps * law.force(u[i + 1]);
    RC_ASSERT(law.force(u[i + 1]) - law.force(u[i]) <= step * law.tangent(u[i + 1]) * slack + rounding);
    RC_ASSERT(law.force(u[i + 1]) - law.force(u[i]) >= step * law.tangent(u[i]) / slack - rounding);
    const double energy_rounding = 8 * eps * law.potential(u[i + 1]);
    RC_ASSERT(law.potential(u[i + 1]) - law.potential(u[i]) <=
              step * law.force(u[i + 1]) * slack + energy_rounding);
    RC_ASSERT(law.potential(u[i + 1]) - law.potential(u[i]) >=
              step * law.force(u[i]) / slack - energy_rounding);
  }
}

RC_GTEST_PROP(ExponentialLawProperty, ForceAndPotentialAreMonotoneAndConvex, ()) {
  check_monotone_and_convex(any_exponential_law());
}

RC_GTEST_PROP(LinearLawProperty, ForceAndPotentialAreMonotoneAndConvex, ()) {
  check_monotone_and_convex(any_linear_law());
}

// Central differences away from the kink and from the start of the linear continuation, at a step that
// balances the error h^2/6 of the third derivative against rounding.
template <class Law>
void check_derivatives(const Law& law, double scale) {
  const double u = any_displacement(law);
  const double step = 1e-4 * scale;
  RC_PRE(std::abs(u - law.gap()) > 2 * step);
  RC_PRE(std::abs(u - law.gap() - ExponentialLaw::linear_beyond * scale) > 2 * step);
  const double width = (u + step) - (u - step);
  const double slope = (law.force(u + step) - law.force(u - step)) / width;
  const double work = (law.potential(u + step) - law.potential(u - step)) / width;
  const double rounding = 64 * eps * (1.0 + std::abs(u) / step);
  RC_ASSERT(std::abs(slope - law.tangent(u)) <=
            1e-8 * law.tangent(u) + rounding * law.force(u + step) / step);
  RC_ASSERT(std::abs(work - law.force(u)) <=
            (1e-8 * law.tangent(u)) * scale + rounding * law.potential(u + step) / step);
}

RC_GTEST_PROP(ExponentialLawProperty, TangentAndForceAreTheDerivatives, ()) {
  const ExponentialLaw law = any_exponential_law();
  check_derivatives(law, 1.0 / law.exponent());
}

RC_GTEST_PROP(LinearLawProperty, TangentAndForceAreTheDerivatives, ()) {
  check_derivatives(any_linear_law(), 1.0);
}

RC_GTEST_PROP(ExponentialLawProperty, DoesNotDependOnTheUnits, ()) {
  const ExponentialLaw law = any_exponential_law();
  const double metre = std::exp2(*rc::gen::inRange(-20, 21));  // powers of two: exact changes of unit
  const double newton = std::exp2(*rc::gen::inRange(-20, 21));
  const ExponentialLaw scaled(law.constant() * newton, law.exponent() / metre, law.gap() * metre);
  const double u = any_displacement(law);
  RC_ASSERT(scaled.force(u * metre) == law.force(u) * newton);
  RC_ASSERT(scaled.tangent(u * metre) == law.tangent(u) * newton / metre);
  RC_ASSERT(scaled.potential(u * metre) == law.potential(u) * newton * metre);
}

}  // namespace
}  // namespace wavebalance::contact
