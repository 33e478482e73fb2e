#include "wavebalance/contact/rigid_law.hpp"

#include <limits>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

}  // namespace

RigidLaw::RigidLaw(double gap, std::optional<double> restitution) : gap_(gap), restitution_(restitution) {
  detail::require_finite("RigidLaw", "gap", gap);
  if (restitution && !zero_to_one.contains(*restitution))
    detail::reject("RigidLaw", "restitution", *restitution, zero_to_one.text());
}

double RigidLaw::force(double displacement) const { return displacement > gap_ ? unbounded : 0.0; }
double RigidLaw::tangent(double displacement) const { return displacement >= gap_ ? unbounded : 0.0; }
double RigidLaw::potential(double displacement) const { return displacement > gap_ ? unbounded : 0.0; }

ForceAndTangent RigidLaw::resolvent(double v, double flexibility) const {
  if (v < gap_) return {};
  return {detail::saturate((v - gap_) / flexibility), 1.0 / flexibility};
}

LawDescription RigidLaw::description() {
  return {
      .name = "rigid",
      .force = "whatever keeps u <= gap; with a restitution, impacts of a contact with mass",
      .parameters = {may_lack({"restitution", "",
                               "ratio of the velocities after and before an impact, for contacts with mass",
                               zero_to_one}),
                     gap_parameter},
      .rigid = true};
}

RigidLaw RigidLaw::of(const LawValues& values) {
  const bool rebounds = values.contains("restitution");
  return RigidLaw(number_of(values, "gap"),
                  rebounds ? std::optional(number_of(values, "restitution")) : std::nullopt);
}

}  // namespace wavebalance::contact
