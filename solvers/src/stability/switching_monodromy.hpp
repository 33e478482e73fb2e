#pragma once
#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// The Floquet multipliers of a motion by falling modulus: the eigenvalues of the map of a perturbation
/// over one period, a matrix exponential between two instants at which contacts change their state. Its
/// states are the states of the structure's poles and the positions w of sliders that stick for a while.
///
/// The force of a contact that sticks changes by k_t (u_t - w), of one that slips by the limit's change,
/// and closed normals by k_n u_n. A transition itself changes no force at first order; a contact that
/// begins to stick sets its slider: after slip the force there is the limit, and after closing the slider
/// is where the gap closes, u_t' / u_n' times the change of the normal displacement behind. Sliders that
/// are not stuck have multipliers of zero. A contact that sticks always is a spring, and the neutral
/// multiplier 1 of its slider is left out.
///
/// Tangents of other contacts are constant over parts of a segment, which are halved until the map changes
/// by less than `settled` of its norm; NaN if it does not converge. No law may depend on the velocity or on
/// other rows. O(segments (n^3 + c^3)) for n states and c active contacts.
Eigen::VectorXcd switching_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                     double frequency, double settled = 1e-9);

}  // namespace wavebalance::solvers
