#include "wavebalance/contact/kelvin_voigt_law.hpp"

#include "checks.hpp"

namespace wavebalance::contact {

KelvinVoigtLaw::KelvinVoigtLaw(double stiffness, double damping, double gap, double depth)
    : stiffness_(stiffness), damping_(damping), gap_(gap), depth_(depth) {
  detail::require_positive("KelvinVoigtLaw", "stiffness", stiffness);
  detail::require_at_least("KelvinVoigtLaw", "damping", damping, 0.0, detail::Bound::closed);
  detail::require_finite("KelvinVoigtLaw", "gap", gap);
  detail::require_at_least("KelvinVoigtLaw", "depth", depth, 0.0, detail::Bound::closed);
}

ForceAndSlopes KelvinVoigtLaw::evaluate(double displacement, double velocity) const {
  const double penetration = displacement - gap_;
  if (penetration <= 0.0) return {};
  const bool rising = penetration < depth_;
  const double x = rising ? penetration / depth_ : 1.0;
  const double damping = damping_ * x * x * (3.0 - 2.0 * x);
  const double force = stiffness_ * penetration + damping * velocity;
  if (force <= 0.0) return {};
  const double rise = rising ? damping_ * 6.0 * x * (1.0 - x) / depth_ : 0.0;
  return {detail::saturate(force), detail::saturate_both(stiffness_ + rise * velocity), damping};
}

double KelvinVoigtLaw::potential(double displacement) const {
  return detail::spring_energy(stiffness_, displacement - gap_);
}

LawDescription KelvinVoigtLaw::description() {
  return {.name = "kelvin_voigt",
          .force = "stiffness d + damping v, d = u - gap > 0, where it does not pull",
          .parameters = {
              {"stiffness", "N/m", "slope of the spring of the Kelvin-Voigt law", above_zero},
              {"damping", "N s/m",
               "damper of the Kelvin-Voigt law, the force stiffness d + damping v of the penetration d = "
               "u - gap > 0 and the velocity v, where that is not negative",
               at_least_zero},
              with_default(
                  {"damping_depth", "m",
                   "penetration over which the damper rises smoothly to its full value; 0: at once, with a "
                   "jump of the force",
                   at_least_zero},
                  0.0),
              gap_parameter}};
}

KelvinVoigtLaw KelvinVoigtLaw::of(const LawValues& values) {
  return {number_of(values, "stiffness"), number_of(values, "damping"), number_of(values, "gap"),
          number_of(values, "damping_depth")};
}

}  // namespace wavebalance::contact
