#include "wavebalance/contact/bilinear_law.hpp"

#include <limits>

#include "checks.hpp"

namespace wavebalance::contact {

BilinearLaw::BilinearLaw(double slope_below, double slope_beyond, double kink)
    : below_(slope_below), beyond_(slope_beyond), kink_(kink) {
  detail::require_finite("BilinearLaw", "slope_below", slope_below);
  detail::require_finite("BilinearLaw", "slope_beyond", slope_beyond);
  detail::require_finite("BilinearLaw", "kink", kink);
}

ForceAndTangent BilinearLaw::evaluate(double displacement) const {
  if (displacement < kink_) return {detail::saturate_both(below_ * displacement), below_};
  const double beyond = displacement - kink_;  // if not a number, passed on in both results
  return {detail::saturate_both(below_ * kink_ + beyond_ * beyond), beyond >= 0.0 ? beyond_ : beyond};
}

double BilinearLaw::potential(double displacement) const {
  const double inner = displacement < kink_ ? displacement : kink_;
  const double outer = displacement < kink_ ? 0.0 : displacement - kink_;
  return detail::saturate_both(0.5 * below_ * inner * inner +
                               (below_ * kink_ + 0.5 * beyond_ * outer) * outer);
}

ForceAndTangent BilinearLaw::resolvent(double v, double flexibility) const {
  const double below = 1.0 + flexibility * below_, beyond = 1.0 + flexibility * beyond_;
  const double at_kink = below_ * kink_, past = v - kink_ - flexibility * at_kink;
  // v / below < kink_ where below > 0; for below < 0 the displacement is on this side for large v.
  if (below != 0.0 && v / below < kink_) return {detail::saturate_both(below_ * (v / below)), below_ / below};
  if (beyond != 0.0 && past / beyond >= 0.0)
    // One division of the whole, since at_kink and the rest cancel where the flexibility is large.
    return {detail::saturate_both((at_kink + beyond_ * (v - kink_)) / beyond), beyond_ / beyond};
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  return {missing, missing};
}

LawDescription BilinearLaw::description() {
  return {
      .name = "bilinear",
      .force = "slopes[0] u up to the gap, from there on with slopes[1]; either may be negative",
      .parameters =
          {list_parameter(
               {"slopes", "N/m",
                "slopes of the bilinear law below and beyond the gap, of either sign; the force is 0 at u "
                "= 0"},
               2),
           {"gap", "m", "displacement at which the slope of the bilinear law changes"}},
      .beyond_gap_alone = false};
}

BilinearLaw BilinearLaw::of(const LawValues& values) {
  return {list_of(values, "slopes")[0], list_of(values, "slopes")[1], number_of(values, "gap")};
}

}  // namespace wavebalance::contact
