#include "wavebalance/contact/cubic_law.hpp"

#include <cmath>

#include "checks.hpp"

namespace wavebalance::contact {

CubicLaw::CubicLaw(double stiffness) : stiffness_(stiffness) {
  if (stiffness == 0.0 || !std::isfinite(stiffness))
    detail::reject("CubicLaw", "stiffness", stiffness, "finite and not zero");
}

ForceAndTangent CubicLaw::evaluate(double displacement) const {
  const double slope = stiffness_ * displacement * displacement;
  return {detail::saturate_both(slope * displacement), detail::saturate_both(3.0 * slope)};
}

double CubicLaw::potential(double displacement) const {
  const double square = displacement * displacement;
  return detail::saturate_both(0.25 * stiffness_ * square * square);
}

// u + c k3 u^3 = v. With a = sqrt(3 c |k3|) and x = 3 a v / 2 the root is (2 / a) sinh(asinh(x) / 3) of a
// hardening law; of a softening one (2 / a) sin(asin(x) / 3) for |x| <= 1, and beyond it the outer root,
// whose sign is the other.
ForceAndTangent CubicLaw::resolvent(double v, double flexibility) const {
  const double a = std::sqrt(3.0 * flexibility * std::abs(stiffness_));
  const double x = 1.5 * a * v;
  double u = 0.0;
  if (stiffness_ > 0.0)
    u = 2.0 / a * std::sinh(std::asinh(x) / 3.0);
  else if (std::abs(x) <= 1.0)
    u = 2.0 / a * std::sin(std::asin(x) / 3.0);
  else
    u = -std::copysign(2.0 / a * std::cosh(std::acosh(std::abs(x)) / 3.0), v);
  const ForceAndTangent at = evaluate(u);
  return {at.force, at.tangent / (1.0 + flexibility * at.tangent)};
}

LawDescription CubicLaw::description() {
  return {.name = "cubic",
          .force = "cubic_stiffness u^3, Duffing's spring, hardening or softening",
          .parameters = {{"cubic_stiffness", "N/m^3",
                          "k3 of the cubic law, the force k3 u^3 of Duffing's spring: hardening above zero, "
                          "softening below",
                          other_than_zero}},
          .beyond_gap_alone = false};
}

CubicLaw CubicLaw::of(const LawValues& values) { return CubicLaw(number_of(values, "cubic_stiffness")); }

}  // namespace wavebalance::contact
