#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {

/// Legendre's polynomials P_0 to P_(count - 1) at points x in [-1, 1]: points x count. O(points count).
Eigen::MatrixXd legendre_values(const Eigen::VectorXd& points, Index count);

/// Whether the recurrence below is stable upwards up to y_(count - 1).
bool follows_upwards(std::complex<double> z, Index count);

/// The integrals of exp(z (x - s)) P_k(s) over s from -1 to x, for k < count and points x in [-1, 1]: the
/// solutions of y' = z y + P_k with y(-1) = 0, for Re z <= 0, to a few units of rounding of the largest.
///
/// Integration by parts gives z y_(k-1) + (2 k + 1) y_k - z y_(k+1) = P_(k+1)(x) - P_(k-1)(x), whose solution
/// wanted neither grows nor decays with k below |z| and decays beyond. The recurrence is followed upwards
/// where that is stable, and beyond solved as a boundary value problem [F. W. J. Olver, J. Res. NBS 71B,
/// 1967]. Scalar is double or std::complex<double>.
template <class Scalar>
class ExponentialIntegrals {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  ExponentialIntegrals(const Eigen::VectorXd& points, Index count);

  /// For one z. O(points (count + |z|)).
  void compute(Scalar z);
  /// points x count.
  Eigen::Ref<const Matrix> values() const { return y_.leftCols(count_); }
  /// exp(z (x + 1)) at the points.
  const Vector& decay() const { return decay_; }

 private:
  void reserve(Index last);
  void solve_downwards(Scalar z, Index from, Index last);

  Eigen::VectorXd points_;
  Index count_;
  Eigen::MatrixXd jumps_;  // points x K: P_(k+1) - P_(k-1) in column k
  Matrix y_;               // points x K
  Vector decay_, inverse_;
};

extern template class ExponentialIntegrals<double>;
extern template class ExponentialIntegrals<std::complex<double>>;

/// The Legendre coefficients of exp(z (x + 1)) on [-1, 1] for Re z <= 0: (2 n + 1) exp(z) i_n(z) with the
/// modified spherical Bessel functions i_n, by their recurrence downwards [J. C. P. Miller], and zeros behind
/// them. Returns how many are above rounding of 1. At least most_coefficients(z) have a place. O(|z|).
Index exponential_series(std::complex<double> z, Eigen::Ref<Eigen::VectorXd> real,
                         Eigen::Ref<Eigen::VectorXd> imag);
Index most_coefficients(std::complex<double> z);

/// Maps the Legendre coefficients of f to the coefficients of the integral of k(x - s - 1) f(s) over s from
/// -1 to x, for the Legendre coefficients of a kernel k, N, and of f, q: (N + q) x q [N. Hale, A. Townsend,
/// SIAM J. Sci. Comput. 36, 2014, doi:10.1137/140955835]. O((N + q) q).
Eigen::MatrixXd convolution(const Eigen::VectorXd& kernel, Index count);

/// Gauss and Legendre's nodes on [-1, 1] and what leads from values there to Legendre coefficients.
struct LegendreNodes {
  explicit LegendreNodes(Index count);

  Index count() const { return points.size(); }
  Eigen::VectorXd points;        ///< q, ascending
  Eigen::MatrixXd values;        ///< q x K: Legendre's polynomials there, more than any series here needs
  Eigen::MatrixXd coefficients;  ///< q x q: of values at the nodes
};

}  // namespace wavebalance::solvers::detail
