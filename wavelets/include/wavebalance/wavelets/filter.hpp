#pragma once
#include <Eigen/Core>

namespace wavebalance::wavelets {

/// Filter p_0..p_{L-1} of the Daubechies scaling function phi(x) = sum_l p_l phi(2x - l), the minimum-phase
/// one, normalised to sum p_l = 2 [JL14, eq. (32)]. `coefficients` = L, even, 2..40; L = 2 is Haar. Computed
/// by spectral factorisation: with N = L/2, |p|^2 = 4 cos^{2N}(xi/2) P(sin^2(xi/2)), P(y) = sum_{k<N}
/// binomial(N-1+k, k) y^k [Daubechies 1992, eq. (6.1.12)]; the roots of P are found and multiplied back in
/// extended precision. Cost O(L^2) per sweep, some tens of sweeps (below a millisecond at L = 40).
/// Throws std::invalid_argument when L is odd or outside 2..40.
Eigen::VectorXd daubechies_filter(int coefficients);

/// Filter of the cardinal B-spline of `degree` 0..19 on [0, degree + 1]: p_k = 2^{-degree} binomial(degree +
/// 1, k). Throws std::invalid_argument when the degree is outside 0..19.
Eigen::VectorXd bspline_filter(int degree);

/// Order N of the zero of the symbol m0(xi) = 1/2 sum_l p_l exp(-i l xi) at xi = pi: the number of
/// vanishing alternating moments sum_l (-1)^l l^k p_l. A moment counts as zero below 1e-11 of the moment of
/// the absolute values. Throws std::invalid_argument for an empty filter or one that does not sum to 2.
int zeros_at_pi(const Eigen::VectorXd& filter);

/// Sobolev exponent s of the refinable function of `filter`: phi is in H^r exactly when r < s (if its integer
/// translates are a Riesz basis). With m0 = ((1 + e^{-i xi})/2)^N q(xi) and rho the spectral radius of the
/// transfer operator f -> |q(xi/2)|^2 f(xi/2) + |q(xi/2 + pi)|^2 f(xi/2 + pi) on trigonometric polynomials,
/// s = N - log2(rho) / 2 [Villemoes 1992; Eirola 1992]. Haar 1/2, cubic B-spline 7/2. Error of a few eps up
/// to L = 40. Cost O(60 L^3).
/// Throws std::invalid_argument for a filter that does not sum to 2 or has no zero at pi.
double sobolev_exponent(const Eigen::VectorXd& filter);

/// Lower bound of the Hoelder exponent of the refinable function, from `iterations` steps of the subdivision
/// scheme of its N-th differences: with g(w) = p(w) / (1 + w)^N and g_j(w) = g(w) g(w^2) .. g(w^{2^{j-1}}),
/// alpha >= -log2( max_n sum_m |g_j[n + 2^j m]| ) / j [Rioul 1992]; the best j is taken. Cost O(L
/// 2^iterations). Throws std::invalid_argument as sobolev_exponent does, and when iterations is
/// outside 1..20.
double hoelder_lower_bound(const Eigen::VectorXd& filter, int iterations = 16);

}  // namespace wavebalance::wavelets
