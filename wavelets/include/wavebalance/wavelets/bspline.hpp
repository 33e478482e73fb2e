#pragma once
#include <Eigen/Core>

namespace wavebalance::wavelets {

/// Values B^(derivative)(fraction + j), j = 0..degree, of the cardinal B-spline of `degree` on [0, degree +
/// 1], for 0 <= fraction < 1; at a knot where the derivative jumps, the limit from the right. Exact
/// polynomial pieces: the recursion n B_n(x) = x B_{n-1}(x) + (n + 1 - x) B_{n-1}(x - 1); for degree 3 these
/// are [JL14, eq. (29)]. Returns degree + 1 values. Cost O(degree^2). Throws std::invalid_argument unless 0
/// <= derivative <= degree and 0 <= fraction < 1.
Eigen::VectorXd bspline_values(int degree, double fraction, int derivative = 0);

/// The polynomial p_3(cos xi) = sum_k B_7(4 + k) exp(-i k xi): the Gram symbol of the integer translates of
/// the cubic B-spline [JL14, eq. (31)].
double cubic_gram_symbol(double cosine);

/// Coefficients c_0..c_largest (c_{-k} = c_k) of the orthonormal cubic B-spline phi = sum_k c_k B_3(. - k),
/// by the trapezoidal rule with 512 points for the integral of [JL14, eq. (30)], which is a discrete Fourier
/// sum of 1/sqrt(p_3(cos xi)). The integrand is periodic and analytic, so the error of the rule is the
/// aliased coefficient c_{512 - k}, below rounding. The coefficients decay like 0.53528^k. Returns
/// largest + 1 values. Cost O(512 largest). Throws std::invalid_argument unless 0 <= largest <= 100.
Eigen::VectorXd orthonormal_cubic_coefficients(int largest = 50);

}  // namespace wavebalance::wavelets
