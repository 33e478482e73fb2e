#pragma once
#include <vector>

#include "wavebalance/contact/force_and_slopes.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A spring and a damper in parallel that do not pull: f = max(k d + c s(d) v, 0) for a penetration d = u -
/// g0 > 0, v the velocity towards the obstacle.
///
/// With a depth of 0 the damper acts fully at once, s = 1, and the force jumps by c v where contact begins. A
/// depth p > 0 lets it rise smoothly over the penetration p, s = x^2 (3 - 2 x) with x = min(d / p, 1), as the
/// impact functions of multibody codes do. O(1). Immutable, may be shared between threads.
class KelvinVoigtLaw {
 public:
  /// stiffness: k > 0, N/m; damping: c >= 0, N s/m; gap: g0, m; depth: p >= 0, m. Throws
  /// std::invalid_argument unless all are finite and in range.
  KelvinVoigtLaw(double stiffness, double damping, double gap, double depth = 0.0);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static KelvinVoigtLaw of(const LawValues& values);

  double gap() const { return gap_; }
  std::vector<double> kinks() const { return {gap_}; }
  /// The gap, and the end of the depth, beyond which the damper is constant.
  std::vector<double> breakpoints() const {
    return depth_ > 0.0 ? std::vector{gap_, gap_ + depth_} : std::vector{gap_};
  }
  static constexpr bool unilateral() { return true; }

  double force(double displacement, double velocity) const { return evaluate(displacement, velocity).force; }
  double tangent(double displacement, double velocity) const {
    return evaluate(displacement, velocity).tangent;
  }
  double damping(double displacement, double velocity) const {
    return evaluate(displacement, velocity).damping;
  }
  double potential(double displacement) const;  ///< J, of the spring
  ForceAndSlopes evaluate(double displacement, double velocity) const;

 private:
  double stiffness_, damping_, gap_, depth_;
};

}  // namespace wavebalance::contact
