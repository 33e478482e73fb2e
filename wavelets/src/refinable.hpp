#pragma once
#include <Eigen/Core>

namespace wavebalance::wavelets::detail {

using ExtendedVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// daubechies_filter before its rounding to double. Filters of 20 coefficients and more need it: the integer
/// values of their derivatives magnify a rounding of the filter some 1e4 times at 40 coefficients.
ExtendedVector extended_daubechies_filter(int coefficients);

/// Phi^(derivative) at the integers first..first + mask.size() - 1, for the refinable Phi(x) = sum_l mask_l
/// Phi(2x - l) with l from `first` and integral 1: the eigenvector of 2^d mask[2k - m] for the eigenvalue 1
/// with sum_k k^j Phi^(d)(k) = (-1)^d d! delta_{jd}, j <= d. Zero at both ends of the support, but for the
/// box, which is left-closed. The derivative must exist; cost O(L^3).
Eigen::VectorXd values_at_integers(const ExtendedVector& mask, int first, int derivative);

/// Phi^(derivative) at n 2^-level, n = 0..(filter.size() - 1) 2^level, by the refinement equation from the
/// integers.
Eigen::VectorXd values_at_dyadics(const ExtendedVector& filter, int level, int derivative);

/// Throws std::invalid_argument "<name> = <value>, allowed: <lowest>..<highest>" unless value lies in that
/// range.
void require_in_range(const char* name, int value, int lowest, int highest);

}  // namespace wavebalance::wavelets::detail
