#include "wavebalance/contact/linear_law.hpp"

#include "checks.hpp"

namespace wavebalance::contact {

LinearLaw::LinearLaw(double stiffness, double gap) : stiffness_(stiffness), gap_(gap) {
  detail::require_positive("LinearLaw", "stiffness", stiffness);
  detail::require_finite("LinearLaw", "gap", gap);
}

ForceAndTangent LinearLaw::evaluate(double displacement) const {
  if (displacement < gap_) return {};
  const double penetration = displacement - gap_;  // if not a number, passed on in both results
  return {detail::saturate(stiffness_ * penetration), penetration >= 0.0 ? stiffness_ : penetration};
}

ForceAndTangent LinearLaw::resolvent(double v, double flexibility) const {
  if (v < gap_) return {};
  const double slope = stiffness_ / (1.0 + stiffness_ * flexibility);
  return {detail::saturate(slope * (v - gap_)), slope};
}

double LinearLaw::potential(double displacement) const {
  return detail::spring_energy(stiffness_, displacement - gap_);
}

void LinearLaw::evaluate(std::span<const double> displacement, std::span<double> force,
                         std::span<double> tangent) const {
  detail::evaluate_each(*this, "LinearLaw::evaluate", displacement, force, tangent);
}

LawDescription LinearLaw::description() {
  return {.name = "linear",
          .force = "stiffness (u - gap) beyond the gap",
          .parameters = {{"stiffness", "N/m", "slope of the linear law", above_zero}, gap_parameter}};
}

LinearLaw LinearLaw::of(const LawValues& values) {
  return {number_of(values, "stiffness"), number_of(values, "gap")};
}

}  // namespace wavebalance::contact
