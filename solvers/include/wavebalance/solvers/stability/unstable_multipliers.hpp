#pragma once
#include <complex>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// How the determinant of a perturbation is evaluated and its argument followed.
struct StabilityOptions {
  /// Harmonics H of the perturbation on either side; 0: as many as the trial functions have, (M - 1) / 2.
  int harmonics = 0;
  /// Limit of the effect of contact beyond H: the largest |S Z(i n omega)^-1 S^T| D at harmonics n > H,
  /// times the cycles of the neighbouring mass on the contact's stiffness during contact, if these are more
  /// than one. The compliance of modes that yield like springs beyond H does not count. Where it is larger,
  /// H harmonics do not represent perturbations: stable motions of stiff contacts look unstable. Count and
  /// signs then come from monodromy().
  double max_omitted = 0.5;
  /// States up to which the monodromy may be taken, at O(states^3); 0: never.
  int max_states = 400;
  /// The same with friction, where each interval between two transitions needs a matrix exponential.
  int max_states_with_friction = 400;
  /// Whether the monodromy also gives the leading multiplier, which requires its eigenvalues.
  bool leading = true;
  int max_evaluations = 2000;    ///< of the determinant in one call
  double max_operations = 1e12;  ///< estimated, real ones, of all these evaluations

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The Floquet multipliers outside the unit circle. If one is on it within its error and none is outside, the
/// status is undamped or on_unit_circle.
struct UnstableMultipliers {
  StabilityStatus status = StabilityStatus::converged;
  int count = -1;        ///< -1 unless converged
  int harmonics = 0;     ///< H taken
  int evaluations = 0;   ///< of the determinant; two real ones count as two
  double winding = 0.0;  ///< the unrounded count; differs from an integer only by rounding
  /// The largest multiplier in modulus, Im >= 0, of the monodromy, if requested, or of two maps; otherwise
  /// NaN.
  std::complex<double> leading{missing, missing};
  double leading_error = 0.0;  ///< estimated, of two maps twice their distance
};

/// The number of Floquet multipliers outside the unit circle, of perturbations v of
///
///   M v'' + C v' + K v + S^T D(t) S v = 0,   D periodic with `frequency` (Hz).
///
/// With v = exp(sigma t) p(t) and the compliance G_sigma(t) = sum_{|n| <= H} S Z(sigma + i n omega)^-1 S^T
/// exp(i n omega t) only the contacts remain. At Gauss nodes t_j with weights w_j, ceil(1.8 H length) + 7
/// on each interval of contact, the determinant
///
///   Delta(sigma) = det(I + G_sigma(t_i - t_j) w_j D(t_j))
///
/// is the quotient of the characteristic polynomials with and without contact, prod (z - mu_j) / (z -
/// exp(lambda_j T)), z = exp(sigma T). The count is the number of poles lambda_j with a positive real part
/// less [arg Delta(i nu)] / pi over nu = 0..omega/2: the generalised Nyquist criterion [N. M. Wereley, S.
/// R. Hall, Frequency response of linear time periodic systems, CDC 1990, doi:10.1109/CDC.1990.203516].
///
/// Two real maps of the period have the multipliers of Delta, exact at z = 1 and at z = -1. Where their
/// distances leave no doubt on which side of the circle these lie, they are counted: two evaluations. Else
/// the argument is followed. Times prod (1 - exp((lambda_j - sigma) T)) it is a polynomial in 1 / z, taken
/// from its values on the circle. Where few powers do not represent these, the argument of the determinant
/// is followed from points around the natural frequencies, folded into that range, and steps are halved
/// until it changes by less than a third of pi and agrees with its derivative.
///
/// If following it needs more than 1e9 operations, as for many long contacts, and the monodromy of at most
/// `options.max_states` states is known, its eigenvalues are counted, or powers of it that vanish show that
/// there are none. With `options.leading` it then comes before the two maps.
///
/// `options.harmonics` must be set. O(evaluations (H n C^2 + nodes^2 H + nodes^3)), two real evaluations, and
/// where these leave doubt 9 to 65 complex ones, as there are multipliers that do not decay. Throws
/// std::invalid_argument for a frequency that is not positive and finite, a stiffness for other contacts, and
/// options out of range.
UnstableMultipliers unstable_multipliers(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                         double frequency, const StabilityOptions& options);

/// The same for a response of `problem` to `laws`. Massless rigid contact uses rigid_monodromy(); with mass
/// the count is unknown (no_finite_stiffness). `dynamics` must belong to problem.structure(); a sweep makes
/// it once.
UnstableMultipliers unstable_multipliers(const ContactDynamics& dynamics, const CondensedProblem& problem,
                                         const ContactLaws& laws, const PeriodicResponse& response,
                                         const StabilityOptions& options = {});

/// The same with the dynamics computed for this call, O(n^3).
UnstableMultipliers unstable_multipliers(const CondensedProblem& problem, const ContactLaws& laws,
                                         const PeriodicResponse& response,
                                         const StabilityOptions& options = {});

/// The signs of two real determinants: 1, -1, or 0 unless converged.
struct StabilitySigns {
  StabilityStatus status = StabilityStatus::converged;
  int fold = 0;  ///< of Delta(0): -1 for an odd number of real multipliers above 1
  int flip = 0;  ///< of Delta(i omega / 2): -1 for an odd number of real multipliers below -1
};

/// Where `fold` changes along a curve there is a fold or a branch point, where `flip` does a period doubling.
/// Two real determinants, whatever the damping. Signs refer to a structure that is stable without contact.
/// Throws as unstable_multipliers does.
StabilitySigns stability_signs(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                               double frequency, const StabilityOptions& options);
StabilitySigns stability_signs(const ContactDynamics& dynamics, const CondensedProblem& problem,
                               const ContactLaws& laws, const PeriodicResponse& response,
                               const StabilityOptions& options = {});

}  // namespace wavebalance::solvers
