#pragma once
#include <optional>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// The Floquet multipliers of a motion with friction, by falling modulus: the eigenvalues of the map of a
/// perturbation over one period. Its states are those of the structure's poles and the positions w of the
/// sliders. Between transitions the force of a contact that sticks changes by k_t (u_t - w), of one that
/// slips by the limit's change, and closed normals by k_n u_n, so that the map is a matrix exponential. A
/// transition itself changes no force at first order; a contact that begins to stick takes its slider along:
/// after slip the force there is the limit, and after closing the slider lies where the gap closes, u_t' /
/// u_n' times the change of the normal displacement behind. Sliders that are not stuck have multipliers of
/// zero. A contact that sticks always is a spring, and the neutral multiplier 1 of its slider is left out.
///
/// Tangents of other contacts are taken as constant over parts of a piece, which are halved until the map
/// changes by less than 1e-9. O(pieces (n + C)^3).
Eigen::VectorXcd friction_monodromy(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                    double frequency);

}  // namespace wavebalance::solvers
