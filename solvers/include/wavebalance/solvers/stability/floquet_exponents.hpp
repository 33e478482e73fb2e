#pragma once
#include <complex>
#include <limits>
#include <vector>

#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {

/// A perturbation exp(sigma t) p(t), p periodic.
struct FloquetExponent {
  std::complex<double> exponent;    ///< sigma, 1/s, 0 <= Im sigma <= omega / 2
  std::complex<double> multiplier;  ///< exp(sigma T), Im >= 0
  /// C x (2H + 1): the harmonics n = -H..H of p at the contacts, the largest with the modulus 1; S p(t) = sum
  /// displacement.col(n + H) exp(2 pi i n t). Zero for an exponent of the structure which contact does not
  /// change, and where laws depend on the velocity.
  Eigen::MatrixXcd displacement;
  /// C x (2H + 1), N/m: the harmonics of D S p, the contact force of that perturbation.
  Eigen::MatrixXcd force;
};

/// Which exponents are computed.
struct FloquetOptions {
  StabilityOptions stability;
  /// H is raised where contact is too stiff for it (StabilityOptions::max_omitted), by at most this factor.
  int max_raise = 4;
  int max_exponents = 4;     ///< exponents of the largest multipliers, a conjugate pair counted once
  double tolerance = 1e-11;  ///< on the last step of Newton's method, relative to the frequency
  int max_iterations = 40;   ///< of Newton's method for each exponent
  /// Expected floating-point operations of a search without starts, beyond which nothing is computed.
  double max_operations = std::numeric_limits<double>::infinity();
  /// Where Newton's method starts, 1/s, as along a curve from the point before; empty: at the roots of the
  /// polynomial that the determinant is on the unit circle.
  std::vector<std::complex<double>> starts;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// Exponents by falling modulus of their multiplier.
struct FloquetExponents {
  StabilityStatus status = StabilityStatus::converged;
  std::vector<FloquetExponent> values;
  int harmonics = 0;    ///< H taken
  int evaluations = 0;  ///< of the determinant
};

/// The exponents sigma with the largest real parts of the perturbations of unstable_multipliers(), with
/// their motions. Newton's method on Delta(sigma) = 0, whose poles at the exponents of the linear structure
/// are divided out by (T/2)(coth((sigma - lambda_j) T/2) - 1) in the logarithmic derivative, and likewise
/// the exponents already found. Without `starts`, Delta times its poles is sampled on the unit circle,
/// where it is a polynomial in 1/z [the numerator prod (1 - mu_j / z)], and the roots of that are the
/// starts: 17 to 513 evaluations, and 5 to 10 for each exponent. With laws that depend on the velocity the
/// exponents come from monodromy(), without motions. unstable_multipliers() then checks whether all
/// exponents with positive real parts are among those found; if not, or if the search is expected to exceed
/// max_operations, the status is effort_limit. Multipliers below 1e-2 are not computed. An undamped structure
/// has poles on that circle and its status is undamped, except with `starts`, which are not checked. Throws
/// std::invalid_argument as unstable_multipliers does.
FloquetExponents floquet_exponents(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                   double frequency, const FloquetOptions& options);
FloquetExponents floquet_exponents(const ContactDynamics& dynamics, const CondensedProblem& problem,
                                   const ContactLaws& laws, const PeriodicResponse& response,
                                   const FloquetOptions& options = {});

}  // namespace wavebalance::solvers
