#pragma once
#include <Eigen/Core>
#include <complex>

#include "wavebalance/solvers/impacts/impact_motion.hpp"

namespace wavebalance::solvers {

/// The Floquet multipliers of a motion with impacts over its period, by falling modulus: eigenvalues of the
/// product of exact flights and of the saltation matrices
///
///   I - (1 + e) / J b v' + ((1 + e) a- / J b - p A b) u' / v-
///
/// of the impacts [P. C. Muller, Chaos Solitons Fractals 5, 1995, doi:10.1016/0960-0779(94)00170-U], y' = A y
/// the states of the poles, b those after a unit impulse, u' and v' displacement and velocity of the contact
/// by the states, and a- its acceleration before the impact. Those that the longest flight leaves no more of
/// than rounding are left out. Empty where they are not found. Throws std::invalid_argument for a motion that
/// has not converged. O(K s n + s^3) for n states of the structure, of which s are left.
Eigen::VectorXcd impact_multipliers(const ImpactMotion& motion);

/// How many multipliers lie outside the unit circle; -1 where none does but some lie on it within their
/// error.
int unstable_count(const Eigen::VectorXcd& multipliers);

/// The determinant of the 2 K equations that displacement and velocity of a perturbation before each impact
/// satisfy where it grows z-fold in a period. With the multipliers mu of all n states and the exponents
/// lambda of the structure over the period T it is prod (z - mu) / prod (z - exp(lambda T)), so that it
/// vanishes at multipliers. Throws std::invalid_argument for a motion that has not converged and for z = 0.
/// O(K^2 n + K^3).
std::complex<double> impact_determinant(const ImpactMotion& motion, std::complex<double> z);

}  // namespace wavebalance::solvers
