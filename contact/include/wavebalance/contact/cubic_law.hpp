#pragma once
#include <vector>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// The cubic spring of Duffing's oscillator, which acts everywhere: f(u) = k3 u^3, hardening for k3 > 0 and
/// softening for k3 < 0.
///
/// In series with a spring of the flexibility c a softening law has three forces for small v and one for
/// large v. Results are limited to the largest double. O(1). Immutable, may be shared between threads.
class CubicLaw {
 public:
  /// k3, N/m^3. Throws std::invalid_argument unless it is finite and not zero.
  explicit CubicLaw(double stiffness);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static CubicLaw of(const LawValues& values);

  double stiffness() const { return stiffness_; }
  static constexpr double gap() { return 0.0; }
  static std::vector<double> kinks() { return {}; }
  static constexpr bool unilateral() { return false; }
  bool monotone() const { return stiffness_ > 0.0; }

  double force(double displacement) const { return evaluate(displacement).force; }      ///< N
  double tangent(double displacement) const { return evaluate(displacement).tangent; }  ///< N/m
  double potential(double displacement) const;                                          ///< J
  ForceAndTangent evaluate(double displacement) const;
  /// The force f = force(v - flexibility f) and its slope by v, by Cardano's formula; of three that which
  /// belongs to the least displacement. flexibility > 0, m/N.
  ForceAndTangent resolvent(double v, double flexibility) const;

 private:
  double stiffness_;
};

}  // namespace wavebalance::contact
