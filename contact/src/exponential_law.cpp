#include "wavebalance/contact/exponential_law.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

// exp(x) - 1 - x for x >= 0, without the cancellation of the plain formula where x is small.
double exponential_remainder(double x) {
  if (x > 1.0) return std::expm1(x) - x;
  double term = 0.5 * x * x;
  double sum = term;
  for (int k = 3; k <= 18; ++k) {  // 1/19! is below the rounding of 1/2
    term *= x / k;
    sum += term;
  }
  return sum;
}

}  // namespace

ExponentialLaw::ExponentialLaw(double constant, double exponent, double gap)
    : constant_(constant), exponent_(exponent), gap_(gap) {
  detail::require_positive("ExponentialLaw", "constant", constant);
  detail::require_positive("ExponentialLaw", "exponent", exponent);
  detail::require_finite("ExponentialLaw", "gap", gap);
}

ForceAndTangent ExponentialLaw::in_contact(double displacement) const {
  return at_argument(exponent_ * (displacement - gap_));
}

ForceAndTangent ExponentialLaw::at_argument(double argument) const {
  if (argument > linear_beyond) {
    const double edge = constant_ * std::expm1(linear_beyond);
    const double slope = edge + constant_;  // per unit of the argument
    return {detail::saturate(edge + slope * (argument - linear_beyond)), detail::saturate(exponent_ * slope)};
  }
  const double force = constant_ * std::expm1(argument);
  return {detail::saturate(force), detail::saturate(exponent_ * (force + constant_))};
}

// With x = alpha (u - g0), b = alpha c a_c and y = alpha (v - g0): x + b (exp(x) - 1) = y. Both bounds of x
// taken lie above the solution.
ForceAndTangent ExponentialLaw::resolvent(double v, double flexibility) const {
  if (v < gap_) return {};
  const double y = exponent_ * (v - gap_), b = exponent_ * flexibility * constant_;
  constexpr int max_iterations = 100;
  double x = std::min(y / (1.0 + b), std::log1p(y / b));
  for (int i = 0; i < max_iterations && x > 0.0; ++i) {
    const ForceAndTangent at = at_argument(x);
    const double rise = 1.0 + flexibility * at.tangent;
    const double step = (x - y + exponent_ * flexibility * at.force) / rise;
    x = std::max(x - step, 0.0);
    if (!(step > 1e-15 * x)) break;
  }
  // The softer of law and spring gives the force without cancellation.
  const double spring = detail::saturate((v - gap_ - x / exponent_) / flexibility);
  const ForceAndTangent law = at_argument(x);
  return {2.0 * x > y ? law.force : spring, 1.0 / (1.0 / law.tangent + flexibility)};
}

double ExponentialLaw::potential_in_contact(double displacement) const {
  const double argument = exponent_ * (displacement - gap_);
  if (!(argument > linear_beyond))
    return detail::saturate(constant_ * (exponential_remainder(argument) / exponent_));
  const double edge = std::expm1(linear_beyond);
  const double beyond = argument - linear_beyond;
  const double energy = (edge - linear_beyond) + beyond * (edge + 0.5 * (edge + 1.0) * beyond);
  return detail::saturate(constant_ * (energy / exponent_));
}

void ExponentialLaw::evaluate(std::span<const double> displacement, std::span<double> force,
                              std::span<double> tangent) const {
  detail::evaluate_each(*this, "ExponentialLaw::evaluate", displacement, force, tangent);
}

LawDescription ExponentialLaw::description() {
  return {.name = "exponential",
          .force = "constant (exp(exponent (u - gap)) - 1) beyond the gap",
          .parameters = {{"constant", "N", "a_c of the exponential law", above_zero},
                         {"exponent", "1/m", "alpha of the exponential law", above_zero},
                         gap_parameter}};
}

ExponentialLaw ExponentialLaw::of(const LawValues& values) {
  return {number_of(values, "constant"), number_of(values, "exponent"), number_of(values, "gap")};
}

}  // namespace wavebalance::contact
