#pragma once
#include <vector>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A linear stop on either side of a clearance, as the backlash between two gears or a shaft in its bearing
/// has: f(u) = k+ (u - g+) beyond g+, f(u) = k- (u + g-) below -g-, and zero between them.
///
/// Results are limited to the largest double. O(1). Immutable, may be shared between threads.
class ClearanceLaw {
 public:
  /// One side: its stiffness k > 0, N/m, and its distance g >= 0 from u = 0, m.
  struct Side {
    double stiffness;
    double gap;
  };

  /// Throws std::invalid_argument unless every stiffness is positive, every gap at least 0, and all are
  /// finite.
  ClearanceLaw(Side above, Side below);
  /// The same stop on both sides.
  ClearanceLaw(double stiffness, double gap) : ClearanceLaw({stiffness, gap}, {stiffness, gap}) {}

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static ClearanceLaw of(const LawValues& values);

  const Side& above() const { return above_; }
  const Side& below() const { return below_; }
  double gap() const { return above_.gap; }  ///< gap on the positive side, m
  std::vector<double> kinks() const { return {-below_.gap, above_.gap}; }
  static constexpr bool unilateral() { return false; }
  static constexpr bool monotone() { return true; }

  double force(double displacement) const { return evaluate(displacement).force; }      ///< N
  double tangent(double displacement) const { return evaluate(displacement).tangent; }  ///< N/m
  double potential(double displacement) const;                                          ///< J
  ForceAndTangent evaluate(double displacement) const;
  /// The force f = force(v - flexibility f) and its slope by v: the stops in series with a spring of
  /// `flexibility` > 0, m/N.
  ForceAndTangent resolvent(double v, double flexibility) const;

 private:
  Side above_, below_;
};

}  // namespace wavebalance::contact
