#pragma once
#include <vector>

#include "wavebalance/contact/force_and_slopes.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// Contact that dissipates energy, of K. H. Hunt and F. R. E. Crossley (J. Appl. Mech. 42, 1975,
/// doi:10.1115/1.3423596): f = max(k d^n (1 + c v), 0) for a penetration d = u - g0 > 0, v the velocity
/// towards the obstacle.
///
/// The force vanishes with the penetration, whatever the velocity, and the contact does not pull. n = 3/2
/// for the contact of two spheres. For small velocities the restitution is 1 - 2 c v / 3 at the velocity v
/// of impact. O(1), one power in contact. Immutable, may be shared between threads.
class HuntCrossleyLaw {
 public:
  /// stiffness: k > 0, N/m^n; power: n >= 1; dissipation: c >= 0, s/m; gap: g0, m. Throws
  /// std::invalid_argument unless all are finite and in range.
  HuntCrossleyLaw(double stiffness, double power, double dissipation, double gap);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static HuntCrossleyLaw of(const LawValues& values);

  double gap() const { return gap_; }
  std::vector<double> kinks() const { return {gap_}; }
  static constexpr bool unilateral() { return true; }

  double force(double displacement, double velocity) const { return evaluate(displacement, velocity).force; }
  double tangent(double displacement, double velocity) const {
    return evaluate(displacement, velocity).tangent;
  }
  double damping(double displacement, double velocity) const {
    return evaluate(displacement, velocity).damping;
  }
  double potential(double displacement) const;  ///< J, of the elastic part, k d^(n+1) / (n + 1)
  ForceAndSlopes evaluate(double displacement, double velocity) const;

 private:
  double stiffness_, power_, dissipation_, gap_;
};

}  // namespace wavebalance::contact
