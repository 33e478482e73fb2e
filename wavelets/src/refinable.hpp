#pragma once
#include <Eigen/Core>

namespace wavebalance::wavelets::detail {

using ExtendedVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// The Daubechies filter with `removed` of its L/2 zeros at pi divided out, 2 ((1 + w)/2)^{L/2 - removed}
/// q(w), sum 2. The product is formed in extended precision, as the coefficients of q reach 1e5 and cancel.
ExtendedVector extended_daubechies_filter(int coefficients, int removed = 0);

/// The same for the B-spline filter of `degree`: the filter of degree - removed, or {2} if no zero is left.
ExtendedVector extended_bspline_filter(int degree, int removed = 0);

/// Phi^(derivative) at the integers from the begin of its support, for the refinable Phi(x) = sum_l m_l
/// Phi(2x - l) of integral 1 whose mask m has `derivative` zeros at pi or more. `divided` is 2^d m(w) / (1 +
/// w)^d, the mask of Phi_d, and Phi^(d) is the d-th backward difference of Phi_d, whose integer values are
/// the eigenvector of divided[2k - m] for the eigenvalue 1 with sum 1. In exact arithmetic the result is the
/// eigenvector of 2^d m[2k - m] with sum_k k^j Phi^(d)(k) = (-1)^d d! delta_{jd}, j <= d. Computed that way,
/// rounding errors would grow with the length of the filter (1e4 times at 40 coefficients) and by 2^d with
/// each level of refinement. Returns divided.size() + derivative values. Those at the ends of the support are
/// 0, except for the box, which is left-closed. The derivative must exist. Cost O(L^3).
Eigen::VectorXd values_at_integers(const ExtendedVector& divided, int derivative);

/// Phi_d as its mask and its values at the integers, from which all other values follow. Cost O(L^3).
struct Refinable {
  Eigen::VectorXd mask, integers;
};
Refinable refinable(const ExtendedVector& divided);

/// Phi^(derivative) at n 2^-level from the begin of the support, by the refinement equation of Phi_d and the
/// differences. Returns (mask.size() + derivative - 1) 2^level + 1 values; cost O(L^2 2^level).
Eigen::VectorXd values_at_dyadics(const Refinable& phi, int level, int derivative);

}  // namespace wavebalance::wavelets::detail
