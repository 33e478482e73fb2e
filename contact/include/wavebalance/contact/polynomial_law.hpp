#pragma once
#include <vector>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// A spring that acts everywhere, f(u) = c_1 u + c_2 u^2 + ... + c_n u^n, by Horner's scheme.
///
/// A force that falls somewhere may leave a structure with several motions or none. Results are limited to
/// the largest double. O(n). Immutable, may be shared between threads.
class PolynomialLaw {
 public:
  /// c_1, c_2, ..., N/m, N/m^2, ... Throws std::invalid_argument when the list is empty, and unless all are
  /// finite and one is not zero.
  explicit PolynomialLaw(std::vector<double> coefficients);

  /// Its row of the catalogue, and the law of complete values.
  static LawDescription description();
  static PolynomialLaw of(const LawValues& values);

  const std::vector<double>& coefficients() const { return coefficients_; }
  static constexpr double gap() { return 0.0; }
  static std::vector<double> kinks() { return {}; }
  static constexpr bool unilateral() { return false; }

  double force(double displacement) const { return evaluate(displacement).force; }      ///< N
  double tangent(double displacement) const { return evaluate(displacement).tangent; }  ///< N/m
  double potential(double displacement) const;                                          ///< J
  ForceAndTangent evaluate(double displacement) const;

 private:
  std::vector<double> coefficients_;
};

}  // namespace wavebalance::contact
