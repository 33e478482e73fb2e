#pragma once
#include <span>

#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A journal in a circular ring, with the displacement (x, y) of its center from the center of the ring:
/// beyond the clearance g the normal force N = k (r - g), r = |(x, y)|, acts along the radius. A journal
/// that turns always slides, so that its friction mu N acts along the tangent, against the motion of its
/// surface: with mu > 0 it turns from x to y, with mu < 0 from y to x. The forces, which oppose positive
/// displacements, are N (x - mu y, y + mu x) / r.
///
/// O(1). Immutable, may be shared between threads.
class RingLaw {
 public:
  /// k > 0, N/m; g > 0, m; mu of either sign. Throws std::invalid_argument for others and such that are not
  /// finite.
  RingLaw(double stiffness, double gap, double friction = 0.0);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static RingLaw of(const LawValues& values);

  static constexpr int rows() { return 2; }
  double stiffness() const { return stiffness_; }
  double gap() const { return gap_; }
  double friction() const { return friction_; }

  /// m, above 0 in contact: (r^2 - g^2) / (2 g), which is smooth at the center. Writes its two slopes.
  double penetration(std::span<const double> displacement, std::span<double> slopes) const;
  /// The two forces (N) in contact, as they go on below the clearance, too, and their slopes (N/m), row after
  /// row: of each force by x and y.
  void closed(std::span<const double> displacement, std::span<double> force, std::span<double> slopes) const;
  /// J, that the ring stores.
  double potential(std::span<const double> displacement) const;

 private:
  double stiffness_, gap_, friction_;
};

}  // namespace wavebalance::contact
