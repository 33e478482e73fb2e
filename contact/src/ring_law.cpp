#include "wavebalance/contact/ring_law.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace wavebalance::contact {

RingLaw::RingLaw(double stiffness, double gap, double friction)
    : stiffness_(stiffness), gap_(gap), friction_(friction) {
  detail::require_positive("RingLaw", "stiffness", stiffness);
  detail::require_positive("RingLaw", "gap", gap);
  detail::require_finite("RingLaw", "friction", friction);
}

double RingLaw::penetration(std::span<const double> displacement, std::span<double> slopes) const {
  const double x = displacement[0], y = displacement[1];
  slopes[0] = x / gap_;
  slopes[1] = y / gap_;
  return 0.5 * ((x / gap_) * x + (y / gap_) * y - gap_);
}

// With w = 1 - g / r the forces are k w (x - mu y) and k w (y + mu x), and the slopes of w are g x / r^3 and
// g y / r^3.
void RingLaw::closed(std::span<const double> displacement, std::span<double> force,
                     std::span<double> slopes) const {
  const double x = displacement[0], y = displacement[1], r = std::hypot(x, y);
  const double share = stiffness_ * (1.0 - gap_ / r), bend = stiffness_ * gap_ / r;
  const double along = x - friction_ * y, across = y + friction_ * x, to_x = x / r, to_y = y / r;
  force[0] = share * along;
  force[1] = share * across;
  slopes[0] = share + bend * (along / r) * to_x;
  slopes[1] = -share * friction_ + bend * (along / r) * to_y;
  slopes[2] = share * friction_ + bend * (across / r) * to_x;
  slopes[3] = share + bend * (across / r) * to_y;
}

double RingLaw::potential(std::span<const double> displacement) const {
  const double depth = std::max(0.0, std::hypot(displacement[0], displacement[1]) - gap_);
  return 0.5 * stiffness_ * depth * depth;
}

LawDescription RingLaw::description() {
  return {
      .name = "ring",
      .force =
          "a journal in a ring, of the displacements x and y from the center of the ring along two "
          "directions: stiffness (r - gap) along the radius r beyond the gap, and friction times that "
          "along the tangent, against the surface of the journal, which turns and always slides",
      .parameters = {{"stiffness", "N/m", "slope of the ring law along the radius", above_zero},
                     {"gap", "m", "clearance of the ring, from its center along every radius", above_zero},
                     may_lack({"friction", "",
                               "coefficient of friction of a journal in a ring, which turns from dofs to "
                               "tangent; without it 0",
                               LawRange{.lower = 0.0, .upper = 1e3}})}};
}

RingLaw RingLaw::of(const LawValues& values) {
  return {number_of(values, "stiffness"), number_of(values, "gap"), number_or(values, "friction", 0.0)};
}

}  // namespace wavebalance::contact
