#include "wavebalance/contact/exponential_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
  require_positive("ExponentialLaw", "constant", constant);
  require_positive("ExponentialLaw", "exponent", exponent);
  require_finite("ExponentialLaw", "gap", gap);
}

Response ExponentialLaw::in_contact(double displacement) const {
  const double argument = exponent_ * (displacement - gap_);
  if (argument > linear_beyond) {
    const double edge = constant_ * std::expm1(linear_beyond);
    const double slope = edge + constant_;  // per unit of the argument
    return {saturate(edge + slope * (argument - linear_beyond)), saturate(exponent_ * slope)};
  }
  const double force = constant_ * std::expm1(argument);
  return {saturate(force), saturate(exponent_ * (force + constant_))};
}

double ExponentialLaw::potential_in_contact(double displacement) const {
  const double argument = exponent_ * (displacement - gap_);
  if (!(argument > linear_beyond)) return saturate(constant_ * (exponential_remainder(argument) / exponent_));
  const double edge = std::expm1(linear_beyond);
  const double beyond = argument - linear_beyond;
  const double energy = (edge - linear_beyond) + beyond * (edge + 0.5 * (edge + 1.0) * beyond);
  return saturate(constant_ * (energy / exponent_));
}

void ExponentialLaw::evaluate(std::span<const double> displacement, std::span<double> force,
                              std::span<double> tangent) const {
  require_equal_lengths("ExponentialLaw", displacement.size(), force.size(), tangent.size());
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    const Response response = evaluate(displacement[i]);
    force[i] = response.force;
    tangent[i] = response.tangent;
  }
}

}  // namespace wavebalance::contact
