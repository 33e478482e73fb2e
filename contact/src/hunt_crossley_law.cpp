#include "wavebalance/contact/hunt_crossley_law.hpp"

#include <cmath>

#include "checks.hpp"

namespace wavebalance::contact {

HuntCrossleyLaw::HuntCrossleyLaw(double stiffness, double power, double dissipation, double gap)
    : stiffness_(stiffness), power_(power), dissipation_(dissipation), gap_(gap) {
  detail::require_positive("HuntCrossleyLaw", "stiffness", stiffness);
  detail::require_at_least("HuntCrossleyLaw", "power", power, 1.0, detail::Bound::closed);
  detail::require_at_least("HuntCrossleyLaw", "dissipation", dissipation, 0.0, detail::Bound::closed);
  detail::require_finite("HuntCrossleyLaw", "gap", gap);
}

ForceAndSlopes HuntCrossleyLaw::evaluate(double displacement, double velocity) const {
  const double penetration = displacement - gap_, factor = 1.0 + dissipation_ * velocity;
  if (penetration < 0.0 || factor <= 0.0) return {};
  const double slope = stiffness_ * std::pow(penetration, power_ - 1.0);  // 1 at d = 0 of a power of 0
  const double spring = slope * penetration;
  return {detail::saturate(spring * factor), detail::saturate(power_ * slope * factor),
          detail::saturate(spring * dissipation_)};
}

double HuntCrossleyLaw::potential(double displacement) const {
  if (displacement <= gap_) return 0.0;
  return detail::saturate(stiffness_ * std::pow(displacement - gap_, power_ + 1.0) / (power_ + 1.0));
}

LawDescription HuntCrossleyLaw::description() {
  return {
      .name = "hunt_crossley",
      .force = "hertz_stiffness d^power (1 + dissipation v), d = u - gap > 0, where it does not pull",
      .parameters = {
          {"hertz_stiffness", "N/m^power",
           "k of the Hunt-Crossley law, the force k d^power (1 + dissipation v) of the penetration d "
           "= u - gap and the velocity v, where that is not negative",
           above_zero},
          with_default({"power", "", "exponent of the penetration; 3/2 for two spheres", {1.0, 10.0}}, 1.5),
          {"dissipation", "s/m", "dissipation of the Hunt-Crossley law", at_least_zero},
          gap_parameter}};
}

HuntCrossleyLaw HuntCrossleyLaw::of(const LawValues& values) {
  return {number_of(values, "hertz_stiffness"), number_of(values, "power"), number_of(values, "dissipation"),
          number_of(values, "gap")};
}

}  // namespace wavebalance::contact
