#pragma once
#include <Eigen/Core>
#include <stdexcept>

#include "wavebalance/wavelets/periodic_basis.hpp"
#include "wavebalance/wavelets/scaling_function.hpp"

namespace wavebalance::wavelets {

/// Thrown when an inner product does not exist: the Sobolev exponents of the two functions do not sum to more
/// than the order of the derivative. The message carries both.
class InadmissiblePairError : public std::domain_error {
 public:
  InadmissiblePairError(const ScalingFunction& trial, const ScalingFunction& weight, int derivative);
  double trial_exponent() const { return trial_exponent_; }
  double weight_exponent() const { return weight_exponent_; }
  int derivative() const { return derivative_; }

 private:
  double trial_exponent_, weight_exponent_;
  int derivative_;
};

/// Whether the integral of phi_w(x - l) phi_t^(derivative)(x) exists as a duality pairing: s_t + s_w >
/// derivative, strictly.
bool connection_exists(const ScalingFunction& trial, const ScalingFunction& weight, int derivative);

/// r[l] for l = first..first + values.size() - 1, zero elsewhere.
struct ConnectionCoefficients {
  int first = 0;
  Eigen::VectorXd values;

  int last() const { return first + static_cast<int>(values.size()) - 1; }
  /// r[l] for any l.
  double operator()(int l) const { return l < first || l > last() ? 0.0 : values[l - first]; }
};

/// Connection coefficients r_d[l], the integrals of phi_w(x - l) phi_t^(d)(x), of a trial function phi_t
/// and a weight phi_w, on the real line. Derivatives on the weight count too: the integral of phi_w^(a)(x -
/// l) phi_t^(b)(x) is (-1)^a r_{a+b}[l]. r_d has the parity of d in l when both functions are the same.
///
/// Method: for the refinable parts B, the integral C(y) of B_w(x) B_t(x + y) is itself refinable, with the
/// filter a_n = 1/2 sum_{k - j = n} p^w_j p^t_k, and r_d = C^(d) at the integers: the eigenvector of 2^d a[2l
/// - m] for the eigenvalue 1 with sum_l l^k C^(d)(l) = (-1)^d d! delta_{kd}, k <= d [Beylkin 1992; JL14,
/// section 3.4], computed as the d-th difference of the eigenvector of 2^d a(w)/(1 + w)^d, which is
/// well-conditioned at any length; then the convolutions with c. Cost O(L^3).
///
/// Throws InadmissiblePairError, and std::invalid_argument for d outside 0..12.
ConnectionCoefficients connection_coefficients(const ScalingFunction& trial, const ScalingFunction& weight,
                                               int derivative);

/// Inner products on the circle of the periodized functions: a[m] is the product of p_i(t) and q_j^(d)(t)
/// for i - j = m modulo M, with p_i, q_j the translates of `weight` and `trial`: the first column of the
/// circulant matrix A_d[i, j]. Exact at every level: a[m] = M^{d-1} sum_l r_d[m + l M] [JL14, section 3.4;
/// Restrepo and Leaf 1993]. Returns M values. Cost O(L^3 + M). Throws as connection_coefficients, and
/// std::invalid_argument when the two bases have different numbers of functions.
Eigen::VectorXd periodic_inner_products(const PeriodicBasis& trial, const PeriodicBasis& weight,
                                        int derivative);

}  // namespace wavebalance::wavelets
