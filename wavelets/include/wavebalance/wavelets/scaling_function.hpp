#pragma once
#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>

namespace wavebalance::wavelets {

/// A scaling function phi = sum_k c_k B(. - k) with orthonormal integer translates, where B is refinable with
/// a finite filter, B(x) = sum_l p_l B(2x - l), integral 1. Daubechies functions have c = delta; the
/// orthonormal cubic B-spline has |k| <= 50 [JL14, eqs. (28), (32), (33)]. Immutable; may be shared between
/// threads.
class ScalingFunction {
 public:
  /// Daubechies function with `coefficients` = L filter coefficients (even, 2..40), support [0, L - 1]; L = 2
  /// is haar(). Computed once per process, then copied. Throws std::invalid_argument as daubechies_filter
  /// does.
  static ScalingFunction daubechies(int coefficients);
  /// 1 on [0, 1), left-closed [JL14, eq. (33)].
  static ScalingFunction haar();
  /// Orthonormal cubic B-spline, symmetric about 2, support [-50, 54] after truncation [JL14, eqs.
  /// (28)-(31)].
  static ScalingFunction orthonormal_bspline();

  /// "haar", "daubechies<L>" or "bspline".
  const std::string& name() const { return name_; }
  /// p_0.., the filter of B; sums to 2.
  const Eigen::VectorXd& filter() const { return filter_; }
  /// c_k, k = first_coefficient()..; sums to 1.
  const Eigen::VectorXd& coefficients() const { return coefficients_; }
  int first_coefficient() const { return first_coefficient_; }
  /// Degree of B when it is a B-spline (Haar 0, cubic 3), so that values exist in closed form at every x.
  std::optional<int> spline_degree() const { return spline_degree_; }

  /// phi vanishes outside [support_begin(), support_end()].
  int support_begin() const { return first_coefficient_; }
  int support_end() const {
    return first_coefficient_ + static_cast<int>(coefficients_.size() + filter_.size()) - 2;
  }

  /// Largest d for which phi^(d) has pointwise values: continuous, except for Haar, whose values are the
  /// left-closed ones. Daubechies: decided by the Sobolev exponent s where floor(s) and ceil(s - 1/2) - 1
  /// agree (embedding and its converse for compact support), else by hoelder_lower_bound. A derivative that
  /// neither proves is treated as nonexistent. DB4 0, DB6 1 (Hoelder exponent 1.0878), cubic B-spline 2.
  int pointwise_derivatives() const { return pointwise_derivatives_; }
  /// s: phi is in H^r exactly when r < s.
  double sobolev_exponent() const { return sobolev_exponent_; }

  /// phi^(derivative) at the dyadic points x = support_begin() + n 2^-level, n = 0..(support length) 2^level.
  /// Daubechies: values at the integers as the eigenvector of the two-scale matrix 2^d p[2k - l] for the
  /// eigenvalue 1 with sum_k k^d phi^(d)(k) = (-1)^d d!, then the refinement equation level by level [JL14,
  /// eq. (32)]; B-spline: polynomial pieces. Cost O(L * support * 2^level).
  /// Throws std::invalid_argument unless 0 <= level <= 24 and 0 <= derivative <= pointwise_derivatives().
  Eigen::VectorXd values(int level, int derivative = 0) const;

  /// Fourier transform, the integral of phi(x) exp(-i xi x). Daubechies: the product of m0(xi / 2^j), j >= 1,
  /// to rounding (absolute error a few eps); B-spline: closed form. Throws std::invalid_argument when xi is
  /// not finite.
  std::complex<double> fourier_transform(double xi) const;
  /// The same at xi = 2 pi cycles. Phases are reduced exactly, so that large dyadic `cycles` lose no
  /// accuracy.
  std::complex<double> fourier_transform_at_cycles(double cycles) const;

 private:
  ScalingFunction() = default;
  static ScalingFunction make_daubechies(int coefficients);

  std::string name_;
  Eigen::VectorXd filter_;
  Eigen::VectorXd coefficients_;
  int first_coefficient_ = 0;
  std::optional<int> spline_degree_;
  int pointwise_derivatives_ = 0;
  double sobolev_exponent_ = 0.0;
};

/// Filter p of phi itself, phi(x) = sum_l p_l phi(2x - l - first), of even length and with an even `first`:
/// the argument of FastWaveletTransform. Indices of its coarse functions are then lower by first / 2 than
/// indices of the translates of phi. Daubechies: filter(), first 0. For the orthonormal B-spline the filter
/// is 2^(-3) (1 + w)^4 C(w^2) / C(w) with C the symbol of c, computed by a discrete Fourier sum. It decays
/// like 0.732^|l| and is truncated to 224 values, which are orthonormal to 1e-13. Cost O(1e5).
struct TwoScaleFilter {
  int first = 0;
  Eigen::VectorXd values;
};
TwoScaleFilter two_scale_filter(const ScalingFunction& phi);

}  // namespace wavebalance::wavelets
