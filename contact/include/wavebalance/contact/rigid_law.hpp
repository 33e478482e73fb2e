#pragma once
#include <optional>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A rigid obstacle at a gap: u <= g0, f >= 0, f (u - g0) = 0 [LL10, eq. (2)].
///
/// The force is not a function of the displacement: beyond the gap it is infinite. Its resolvent is, and the
/// force form of the balance needs no more, where the contact has no mass. A contact with mass meets the
/// obstacle in impacts, which leave it with the velocity -e v [Newton] where it arrives with v. O(1).
/// Immutable, may be shared between threads.
class RigidLaw {
 public:
  /// gap: g0, m; restitution: e of impacts, 0..1, or none of a contact without mass. Throws
  /// std::invalid_argument for numbers that are not finite or out of range.
  explicit RigidLaw(double gap, std::optional<double> restitution = {});

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static RigidLaw of(const LawValues& values);

  double gap() const { return gap_; }
  std::optional<double> restitution() const { return restitution_; }
  static constexpr bool unilateral() { return true; }

  double force(double displacement) const;      ///< N, 0 or infinite
  double tangent(double displacement) const;    ///< N/m, 0 or infinite
  double potential(double displacement) const;  ///< J, 0 or infinite

  /// f = max(v - g0, 0) / flexibility and its slope: the obstacle behind a spring. flexibility > 0, m/N.
  ForceAndTangent resolvent(double v, double flexibility) const;

 private:
  double gap_;
  std::optional<double> restitution_;
};

}  // namespace wavebalance::contact
