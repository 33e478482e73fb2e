#include "wavebalance/contact/rigid_law.hpp"

#include <limits>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

}  // namespace

RigidLaw::RigidLaw(double gap) : gap_(gap) { detail::require_finite("RigidLaw", "gap", gap); }

double RigidLaw::force(double displacement) const { return displacement > gap_ ? unbounded : 0.0; }
double RigidLaw::tangent(double displacement) const { return displacement >= gap_ ? unbounded : 0.0; }
double RigidLaw::potential(double displacement) const { return displacement > gap_ ? unbounded : 0.0; }

ForceAndTangent RigidLaw::resolvent(double v, double flexibility) const {
  if (v < gap_) return {};
  return {detail::saturate((v - gap_) / flexibility), 1.0 / flexibility};
}

LawDescription RigidLaw::description() {
  return {.name = "rigid", .force = "whatever keeps u <= gap", .parameters = {gap_parameter}, .rigid = true};
}

RigidLaw RigidLaw::of(const LawValues& values) { return RigidLaw(number_of(values, "gap")); }

}  // namespace wavebalance::contact
