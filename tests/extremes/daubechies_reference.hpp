#pragma once
#include <Eigen/Core>

namespace wavebalance::extremes {

/// Errors of the Daubechies filter of `coefficients` (even, 2..40) in double precision, from quadruple
/// precision.
struct FilterAccuracy {
  int coefficients = 0;
  double filter_error = 0.0;    ///< max |p_l - exact| / max |p_l|
  double relative_error = 0.0;  ///< max |p_l - exact| / |p_l|: the smallest coefficients, too
  double orthogonality =
      0.0;  ///< max over m of |sum_l p_l p_{l+2m} - 2 delta_m|, the double filter, summed exactly
  double condition = 0.0;         ///< condition number of the equations of the filter, 2-norm
  double values_error = 0.0;      ///< max |phi(k) - exact| at the integers, over the largest
  double values_condition = 0.0;  ///< condition number of the equations for phi at the integers
};

/// The filter by Newton's method, in quadruple precision, on the equations that define it,
///   sum_l p_l p_{l+2m} = 2 delta_m,   sum_l (-1)^l T_n(x_l) p_l = 0,   m, n = 0..L/2-1,
/// T_n Chebyshev polynomials and x_l the l-th of L uniform points of [-1, 1]: no root of any polynomial, on
/// which wavelets::daubechies_filter rests. It starts from that one, which only decides which solution is
/// meant. O(L^3).
FilterAccuracy filter_accuracy(int coefficients);

}  // namespace wavebalance::extremes
