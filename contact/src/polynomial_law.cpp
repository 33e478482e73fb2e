#include "wavebalance/contact/polynomial_law.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "checks.hpp"

namespace wavebalance::contact {

PolynomialLaw::PolynomialLaw(std::vector<double> coefficients) : coefficients_(std::move(coefficients)) {
  for (const double one : coefficients_) detail::require_finite("PolynomialLaw", "a coefficient", one);
  if (std::all_of(coefficients_.begin(), coefficients_.end(), [](double one) { return one == 0.0; }))
    throw std::invalid_argument(
        "PolynomialLaw: coefficients has no entry that is not zero; give one or more");
}

ForceAndTangent PolynomialLaw::evaluate(double displacement) const {
  double force = 0.0, tangent = 0.0;
  for (std::size_t i = coefficients_.size(); i-- > 0;) {
    const auto degree = static_cast<double>(i + 1);
    force = force * displacement + coefficients_[i];
    tangent = tangent * displacement + degree * coefficients_[i];
  }
  return {detail::saturate_both(force * displacement), detail::saturate_both(tangent)};
}

double PolynomialLaw::potential(double displacement) const {
  double energy = 0.0;
  for (std::size_t i = coefficients_.size(); i-- > 0;)
    energy = energy * displacement + coefficients_[i] / static_cast<double>(i + 2);
  return detail::saturate_both(energy * displacement * displacement);
}

LawDescription PolynomialLaw::description() {
  return {.name = "polynomial",
          .force = "c_1 u + c_2 u^2 + ..., polynomial = [c_1, c_2, ...]",
          .parameters = {list_parameter(
              {"polynomial", "N/m, N/m^2, ...",
               "c_1, c_2, ... of the polynomial law, the force c_1 u + c_2 u^2 + ..."})},
          .beyond_gap_alone = false};
}

PolynomialLaw PolynomialLaw::of(const LawValues& values) {
  return PolynomialLaw(list_of(values, "polynomial"));
}

}  // namespace wavebalance::contact
