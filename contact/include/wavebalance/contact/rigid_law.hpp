#pragma once
#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A rigid obstacle at a gap: u <= g0, f >= 0, f (u - g0) = 0 [LL10, eq. (2)].
///
/// The force is not a function of the displacement: beyond the gap it is infinite. Its resolvent is, and the
/// force form of the balance needs no more. O(1). Immutable, may be shared between threads.
class RigidLaw {
 public:
  /// gap: g0, m. Throws std::invalid_argument unless it is finite.
  explicit RigidLaw(double gap);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static RigidLaw of(const LawValues& values);

  double gap() const { return gap_; }
  static constexpr bool unilateral() { return true; }

  double force(double displacement) const;      ///< N, 0 or infinite
  double tangent(double displacement) const;    ///< N/m, 0 or infinite
  double potential(double displacement) const;  ///< J, 0 or infinite

  /// f = max(v - g0, 0) / flexibility and its slope: the obstacle behind a spring. flexibility > 0, m/N.
  ForceAndTangent resolvent(double v, double flexibility) const;

 private:
  double gap_;
};

}  // namespace wavebalance::contact
