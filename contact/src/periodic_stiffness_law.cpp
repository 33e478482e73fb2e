#include "wavebalance/contact/periodic_stiffness_law.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace wavebalance::contact {

PeriodicStiffnessLaw::PeriodicStiffnessLaw(double stiffness, double gap) : stiffness_(stiffness), gap_(gap) {
  detail::require_positive("PeriodicStiffnessLaw", "stiffness", stiffness);
  if (!(gap >= 0.0) || !std::isfinite(gap))
    detail::reject("PeriodicStiffnessLaw", "gap", gap, at_least_zero.text());
}

double PeriodicStiffnessLaw::penetration(std::span<const double> rows, std::span<double> slopes) const {
  slopes[0] = gap_ > 0.0 ? rows[0] / gap_ : 0.0;
  slopes[1] = 0.0;
  return gap_ > 0.0 ? 0.5 * (slopes[0] * rows[0] - gap_) : 1.0;
}

void PeriodicStiffnessLaw::closed(std::span<const double> rows, std::span<double> force,
                                  std::span<double> slopes) const {
  const double depth = rows[0] - std::copysign(gap_, rows[0]);
  const double now = stiffness_ * (1.0 + rows[1] / signal_unit);
  force[0] = now * depth;
  force[1] = 0.0;
  slopes[0] = now;
  slopes[1] = slopes[2] = slopes[3] = 0.0;
}

double PeriodicStiffnessLaw::potential(std::span<const double> rows) const {
  const double depth = std::max(0.0, std::abs(rows[0]) - gap_);
  return 0.5 * stiffness_ * (1.0 + rows[1] / signal_unit) * depth * depth;
}

LawDescription PeriodicStiffnessLaw::description() {
  return {
      .name = "periodic_stiffness",
      .force =
          "k(t) u, with a gap k(t) (u - gap) beyond it and k(t) (u + gap) below -gap; k(t) = stiffness + "
          "the sum of stiffness_harmonics[m] cos(m 2 pi frequency t + stiffness_phases[m]), m = 1, 2, ...",
      .parameters =
          {{"stiffness", "N/m", "mean of a periodic stiffness", above_zero},
           list_parameter({"stiffness_harmonics", "N/m",
                           "amplitudes of a periodic stiffness at the forcing frequency, at twice it, ..."}),
           may_lack(list_parameter(
               {"stiffness_phases", "degrees",
                "phase leads of stiffness_harmonics relative to a cosine, one each; 0 if not given"})),
           may_lack(
               {"gap", "m", "half the backlash of a periodic stiffness; 0 if not given", at_least_zero})},
      .beyond_gap_alone = false};
}

PeriodicStiffnessLaw PeriodicStiffnessLaw::of(const LawValues& values) {
  if (const auto phases = values.find("stiffness_phases"); phases != values.end()) {
    const std::size_t given = list_of(values, "stiffness_phases").size(),
                      wanted = list_of(values, "stiffness_harmonics").size();
    if (given != wanted)
      throw LawFault("stiffness_phases", "there are " + std::to_string(given) +
                                             "; expected one for each of " + std::to_string(wanted) +
                                             " stiffness_harmonics");
  }
  return PeriodicStiffnessLaw(number_of(values, "stiffness"), number_or(values, "gap", 0.0));
}

}  // namespace wavebalance::contact
