#pragma once
#include <span>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A linear spring at a gap, without adhesion: f_c(u) = k max(u - g0, 0).
///
/// No result exceeds the largest double, so force and potential are finite for every finite displacement. A
/// displacement that is not a number gives results that are not a number. O(1). Immutable, may be shared
/// between threads.
class LinearLaw {
 public:
  /// stiffness: k > 0, N/m; gap: g0, m. Throws std::invalid_argument unless both are finite and k positive.
  LinearLaw(double stiffness, double gap);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static LinearLaw of(const LawValues& values);

  double stiffness() const { return stiffness_; }
  double gap() const { return gap_; }

  double force(double displacement) const { return evaluate(displacement).force; }  ///< N, >= 0
  /// N/m; at the kink u = g0 the right-hand slope k.
  double tangent(double displacement) const { return evaluate(displacement).tangent; }
  double potential(double displacement) const;  ///< J, k/2 max(u - g0, 0)^2

  ForceAndTangent evaluate(double displacement) const;
  static constexpr bool unilateral() { return true; }
  /// f = max(v - g0, 0) / (1/k + flexibility) and its slope: the spring in series with another of
  /// `flexibility` > 0, m/N.
  ForceAndTangent resolvent(double v, double flexibility) const;
  /// Force and tangent of arrays of one length. O(n). Throws std::invalid_argument if the lengths differ.
  void evaluate(std::span<const double> displacement, std::span<double> force,
                std::span<double> tangent) const;

 private:
  double stiffness_;
  double gap_;
};

}  // namespace wavebalance::contact
