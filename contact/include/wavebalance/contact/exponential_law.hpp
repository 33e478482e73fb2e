#pragma once
#include <span>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// The exponential spring of [JL14, eq. (5)] that approximates a rigid obstacle at a gap,
///
///     f_c(u) = max(a_c (exp(alpha (u - g0)) - 1), 0).
///
/// Where alpha (u - g0) exceeds `linear_beyond` the force is continued by its tangent (once continuously
/// differentiable), and no result exceeds the largest double. Force, tangent and potential are thus finite
/// for every finite displacement; below that bound tangent and force are exact derivatives of force and
/// potential. A displacement that is not a number gives results that are not a number. O(1); the
/// exponential is evaluated in contact only. Immutable, may be shared between threads.
class ExponentialLaw {
 public:
  /// alpha (u - g0) at which the linear continuation starts; the force is 1e130 a_c there.
  static constexpr double linear_beyond = 300.0;

  /// constant: a_c > 0, N; exponent: alpha > 0, 1/m; gap: g0, m. Throws std::invalid_argument unless all are
  /// finite and the first two positive.
  ExponentialLaw(double constant, double exponent, double gap);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static ExponentialLaw of(const LawValues& values);

  double constant() const { return constant_; }
  double exponent() const { return exponent_; }
  double gap() const { return gap_; }

  /// N, >= 0.
  double force(double displacement) const {
    return displacement <= gap_ ? 0.0 : in_contact(displacement).force;
  }
  /// N/m; at the kink u = g0 the right-hand slope a_c alpha.
  double tangent(double displacement) const {
    return displacement < gap_ ? 0.0 : in_contact(displacement).tangent;
  }
  /// J, the integral of the force from the gap: the contact energy of [JL14, eq. (35)].
  static constexpr bool unilateral() { return true; }
  double potential(double displacement) const {
    return displacement <= gap_ ? 0.0 : potential_in_contact(displacement);
  }

  /// f = force(v - flexibility f) and its slope by v, flexibility > 0, m/N: the spring in series with a
  /// linear one. By a Newton iteration from above, which converges monotonically as the force is convex.
  ForceAndTangent resolvent(double v, double flexibility) const;

  /// Force and tangent at the cost of one exponential.
  ForceAndTangent evaluate(double displacement) const {
    return displacement < gap_ ? ForceAndTangent{} : in_contact(displacement);
  }
  /// The same for arrays of one length, which must not overlap unless they are the same. O(n). Throws
  /// std::invalid_argument if the lengths differ.
  void evaluate(std::span<const double> displacement, std::span<double> force,
                std::span<double> tangent) const;

 private:
  ForceAndTangent in_contact(double displacement) const;
  ForceAndTangent at_argument(double argument) const;  // exponent (displacement - gap)
  double potential_in_contact(double displacement) const;

  double constant_;
  double exponent_;
  double gap_;
};

}  // namespace wavebalance::contact
