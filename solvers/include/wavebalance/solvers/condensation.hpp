#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <memory>
#include <stdexcept>

#include "wavebalance/solvers/linear_structure.hpp"

namespace wavebalance::solvers {

/// The dynamic stiffness is singular to working precision: an undamped structure driven at a natural
/// frequency, or a pair whose symbol vanishes.
class SingularSystem : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a contact degree of freedom sees of a structure at one dynamic stiffness Z = s2 M + s1 C + s0 K.
struct CondensedPoint {
  std::complex<double> compliance;     ///< e^T Z^-1 e, m/N
  std::complex<double> load_response;  ///< e^T Z^-1 load, m for a load of unit time function
  /// Derivatives of both along dZ = d2 M + d1 C + d0 K.
  std::complex<double> compliance_slope;
  std::complex<double> load_response_slope;
};

/// The three complex factors of M, C and K.
using StiffnessFactors = std::array<std::complex<double>, 3>;

/// The same three factors for each k of a spectrum over translates.
using StiffnessSpectrum = std::array<Eigen::VectorXcd, 3>;

/// CondensedPoint for each k of a spectrum.
struct CondensedSpectrum {
  Eigen::VectorXcd compliance, load_response;              ///< m/N; m
  Eigen::VectorXcd compliance_slope, load_response_slope;  ///< along the rates
};

/// Condensation of a structure on its contact degree of freedom: rule 1 of the solvers, after which no cost
/// depends on the structure. Tridiagonal matrices (a bar) take O(n) a point; any other sparse matrices one
/// sparse LU a point. Immutable after construction except for work space: one object a thread.
class Condensation {
 public:
  /// Throws std::invalid_argument as LinearStructure::validate does, and for unsymmetric matrices.
  explicit Condensation(const LinearStructure& structure);
  Condensation(Condensation&&) noexcept;
  Condensation& operator=(Condensation&&) noexcept;
  ~Condensation();

  int size() const;

  /// Factors {s2, s1, s0} of M, C, K, and their rates {d2, d1, d0}. Throws SingularSystem.
  CondensedPoint at(const StiffnessFactors& factors, const StiffnessFactors& rates);

  /// at() for all k at once, with results resized to fit. A bar that is loaded and touches at its last degree
  /// of freedom takes one forward recursion, vectorised over k. O(n K).
  void condense(const StiffnessSpectrum& factors, const StiffnessSpectrum& rates, CondensedSpectrum& result);

  /// The full displacement Z^-1 (load a - e b), n values, for a load of amplitude a and a contact force b.
  Eigen::VectorXcd recover(const StiffnessFactors& factors, std::complex<double> load_amplitude,
                           std::complex<double> contact_force);

  class Method;  ///< how one dynamic stiffness is solved; see condensation.cpp

 private:
  std::unique_ptr<Method> method_;
};

}  // namespace wavebalance::solvers
