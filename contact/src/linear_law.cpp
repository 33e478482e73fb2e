#include "wavebalance/contact/linear_law.hpp"

#include <cstddef>

#include "checks.hpp"

namespace wavebalance::contact {

LinearLaw::LinearLaw(double stiffness, double gap) : stiffness_(stiffness), gap_(gap) {
  require_positive("LinearLaw", "stiffness", stiffness);
  require_finite("LinearLaw", "gap", gap);
}

Response LinearLaw::evaluate(double displacement) const {
  if (displacement < gap_) return {};
  const double penetration = displacement - gap_;  // if not a number, passed on in both results
  return {saturate(stiffness_ * penetration), penetration >= 0.0 ? stiffness_ : penetration};
}

double LinearLaw::potential(double displacement) const {
  if (displacement <= gap_) return 0.0;
  const double penetration = displacement - gap_;
  return saturate(0.5 * (stiffness_ * penetration * penetration));
}

void LinearLaw::evaluate(std::span<const double> displacement, std::span<double> force,
                         std::span<double> tangent) const {
  require_equal_lengths("LinearLaw", displacement.size(), force.size(), tangent.size());
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    const Response response = evaluate(displacement[i]);
    force[i] = response.force;
    tangent[i] = response.tangent;
  }
}

}  // namespace wavebalance::contact
