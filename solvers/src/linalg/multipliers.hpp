#pragma once
#include <Eigen/Core>
#include <complex>

namespace wavebalance::solvers::detail {

/// The eigenvalues of a map over a period by falling modulus, NaN if the iteration does not converge. The map
/// is known to 1e-12 of its norm, by rounding and by the equations that it solves, so that a simple
/// eigenvalue is known to 1e-12 |map| / |y^H x| with its unit vectors y and x on the left and right.
/// Those whose distance to the unit circle is less are put on it, since their side is not known: the
/// multipliers of an undamped structure are all there. O(n^3).
Eigen::VectorXcd map_multipliers(Eigen::MatrixXd map);

/// The multiplier exp(exponent) of a structure without contact, on the circle where damping is below 1e-10 of
/// the exponent, in which it is rounding.
std::complex<double> free_multiplier(std::complex<double> exponent);

/// Whether a multiplier lies on the unit circle, where map_multipliers() puts it, or outside.
bool lies_on_circle(std::complex<double> multiplier);
bool lies_outside_circle(std::complex<double> multiplier);

/// How many multipliers lie outside the unit circle. -1 where that is not known: there are none, some are
/// NaN, or none lies outside but some lie on it.
int count_outside(const Eigen::VectorXcd& multipliers);

}  // namespace wavebalance::solvers::detail
