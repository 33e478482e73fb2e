#pragma once
#include <vector>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A spring of two slopes, which acts everywhere: f(u) = k1 u up to a kink u1, and beyond it
/// f(u) = k1 u1 + k2 (u - u1).
///
/// A slope may be negative, which softens the structure. In series with a spring of the flexibility c the law
/// has one force where 1 + c k1 > 0 and 1 + c k2 > 0; where only one of them holds it has two or none, and
/// likewise a structure may have several motions or none. Results are limited to the largest double. O(1).
/// Immutable, may be shared between threads.
class BilinearLaw {
 public:
  /// slope_below: k1, slope_beyond: k2, N/m, of any sign; kink: u1, m. Throws std::invalid_argument unless
  /// all are finite.
  BilinearLaw(double slope_below, double slope_beyond, double kink);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static BilinearLaw of(const LawValues& values);

  double slope_below() const { return below_; }
  double slope_beyond() const { return beyond_; }
  double gap() const { return kink_; }  ///< the kink, m
  std::vector<double> kinks() const { return {kink_}; }
  /// Whether the force is zero below the kink and never negative.
  bool unilateral() const { return below_ == 0.0 && beyond_ >= 0.0; }

  bool monotone() const { return below_ >= 0.0 && beyond_ >= 0.0; }

  double force(double displacement) const { return evaluate(displacement).force; }      ///< N
  double tangent(double displacement) const { return evaluate(displacement).tangent; }  ///< N/m; at u1: k2
  double potential(double displacement) const;                                          ///< J, from 0
  ForceAndTangent evaluate(double displacement) const;
  /// The force f = force(v - flexibility f) and its slope by v; below the kink where there are two, not a
  /// number where there is none. flexibility > 0, m/N.
  ForceAndTangent resolvent(double v, double flexibility) const;

 private:
  double below_, beyond_, kink_;
};

}  // namespace wavebalance::contact
