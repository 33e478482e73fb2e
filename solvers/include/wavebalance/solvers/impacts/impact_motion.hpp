#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::solvers {

/// An impact to start from.
struct ImpactGuess {
  int contact = 0;
  double time = 0.0;     ///< periods of the motion
  double impulse = 0.0;  ///< N s
};

/// The periodic motion near the impacts of a start, in any order, of contacts that all have a restitution:
/// contact c stays at or below its gap, and where it reaches it with the velocity v > 0, an impulse p along
/// its direction leaves it with the velocity -e_c v. With J = S M^-1 S^T, p J_cc = (1 + e_c) v, and with the
/// periodic Green function G of the contacts, made of their poles,
///
///   u(t) = u0(t) - sum_i p_i G(t - t_i),  u_i(t_i) = gap_i,  p_i J_ii = (1 + e) v_i(t_i-),
///
/// 2 K equations for instants and impulses of K impacts, by Newton's method with exact derivatives [S. W.
/// Shaw, P. J. Holmes, J. Sound Vib. 90, 1983, doi:10.1016/0022-460X(83)90407-8, for one degree of freedom].
/// Without impacts it is the motion without contact. `converged` means: the equations hold to rounding,
/// impulses push, and between impacts no contact passes its gap, which a bound on the third derivative of
/// the motion proves to 1e-12 of its size. Its multipliers are the eigenvalues of the product of exact
/// flights and of the saltation matrices
///
///   I - (1 + e) / J b v' + ((1 + e) a- / J b - p A b) u' / v-
///
/// of the impacts [P. C. Muller, Chaos Solitons Fractals 5, 1995, doi:10.1016/0960-0779(94)00170-U], y' = A y
/// the states of the poles, b those after a unit impulse, u' and v' displacement and velocity of the contact
/// by the states, and a- its acceleration before the impact.
///
/// Throws std::invalid_argument for sizes that do not fit, numbers out of their range, structural damping, a
/// structure that is free to move, a contact without mass, which has no impacts, and a start with a contact
/// that does not exist or a number that is not finite. The observer is called before each of at most 40
/// steps, O(K^2 poles + K^3).
ExactSolution impact_motion(const ExactProblem& problem, const std::vector<ImpactGuess>& start,
                            const Observer& observer = {});

/// C x C, 1/kg: S M^-1 S^T, the velocities of the contacts by impulses of 1 N s. O(C^2 poles).
Eigen::MatrixXd inverse_contact_mass(const ContactDynamics& dynamics);

}  // namespace wavebalance::solvers
