#include "wavebalance/contact/clearance_law.hpp"

#include "checks.hpp"

namespace wavebalance::contact {

ClearanceLaw::ClearanceLaw(Side above, Side below) : above_(above), below_(below) {
  detail::require_positive("ClearanceLaw", "above.stiffness", above.stiffness);
  detail::require_positive("ClearanceLaw", "below.stiffness", below.stiffness);
  detail::require_at_least("ClearanceLaw", "above.gap", above.gap, 0.0, detail::Bound::closed);
  detail::require_at_least("ClearanceLaw", "below.gap", below.gap, 0.0, detail::Bound::closed);
}

ForceAndTangent ClearanceLaw::evaluate(double displacement) const {
  if (displacement < -below_.gap)
    return {detail::saturate_both(below_.stiffness * (displacement + below_.gap)), below_.stiffness};
  if (displacement < above_.gap) return {};
  const double penetration = displacement - above_.gap;  // if not a number, passed on in both results
  return {detail::saturate(above_.stiffness * penetration),
          penetration >= 0.0 ? above_.stiffness : penetration};
}

double ClearanceLaw::potential(double displacement) const {
  const double force = evaluate(displacement).force;
  const double penetration = displacement < 0.0 ? displacement + below_.gap : displacement - above_.gap;
  return force == 0.0 ? 0.0 : detail::saturate(0.5 * force * penetration);
}

ForceAndTangent ClearanceLaw::resolvent(double v, double flexibility) const {
  const auto series = [&](const Side& side, double penetration) {
    const double slope = side.stiffness / (1.0 + side.stiffness * flexibility);
    return ForceAndTangent{detail::saturate_both(slope * penetration), slope};
  };
  if (v < -below_.gap) return series(below_, v + below_.gap);
  if (v < above_.gap) return {};
  return series(above_, v - above_.gap);
}

LawDescription ClearanceLaw::description() {
  return {
      .name = "clearance",
      .force = "stiffness (u - gap) beyond the gap, and likewise on the other side of the backlash",
      .parameters = {{"stiffness", "N/m", "slope of the clearance law", above_zero},
                     {"gap", "m", "gap of the clearance law on the positive side", at_least_zero},
                     same_as("stiffness", {"stiffness_below", "N/m",
                                           "slope of the clearance law on the negative side", above_zero}),
                     same_as("gap", {"gap_below", "m",
                                     "gap of the clearance law on the negative side: u >= -gap_below",
                                     at_least_zero})},
      .beyond_gap_alone = false};
}

ClearanceLaw ClearanceLaw::of(const LawValues& values) {
  return {{number_of(values, "stiffness"), number_of(values, "gap")},
          {number_of(values, "stiffness_below"), number_of(values, "gap_below")}};
}

}  // namespace wavebalance::contact
