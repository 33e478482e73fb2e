#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// How the variational equations are integrated.
struct MonodromyOptions {
  int nodes =
      20;  ///< Gauss nodes on each piece of an interval of contact, which is halved where they do not do
  /// Largest change over a segment of the phase of the highest mode and of the contact's stiffness on the
  /// neighbouring mass, rad.
  double max_phase = 12.0;
  int max_segments = 500;  ///< at most, of a contact that lasts the whole period

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// All Floquet multipliers of M v'' + C v' + K v + S^T D(t) S v = 0, by falling modulus: the eigenvalues of
/// the map of a perturbation over one period. Free flight is exact in the poles of the structure. In contact
/// the displacements of the contacts satisfy the Volterra equation
///
///   u(t) + integral_a^t h(t - s) D(s) u(s) ds = free motion,   h(t) = sum_l r_l exp(lambda_l t),
///
/// collocated at Gauss nodes; segments end where any contact opens or closes. It shares neither harmonics
/// nor the determinant with unstable_multipliers() and serves to check it. Any number of contacts, massless
/// ones too. A reduced structure has the multipliers of its reduced modes. m of the n states are more than
/// rounding after the longest free flight; the multipliers of the others are zero. O(segments (nodes^2 n
/// C^2 + (nodes C)^3 + nodes C n m) + m^3). Throws std::invalid_argument for a frequency (Hz) that is not
/// positive and finite, a stiffness whose status is not converged, and options out of range. NaN where the
/// contact is so stiff that max_segments do not resolve it.
Eigen::VectorXcd monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                           double frequency, const MonodromyOptions& options = {});

/// The same for rigid obstacles and contacts that have damping but no mass: the limit of monodromy() for a
/// stiffness that tends to infinity on the intervals of `contact`, whose status and tangent are not used. A
/// perturbation is projected by the impulse that closes the contact, and the contact is held until it opens,
/// which changes no velocity. NaN for a contact with mass, where no limit exists, or without damping.
/// O(pieces n^3). Throws std::invalid_argument for a frequency (Hz) that is not positive and finite and for
/// intervals of other contacts.
Eigen::VectorXcd rigid_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& contact,
                                 double frequency);

}  // namespace wavebalance::solvers
