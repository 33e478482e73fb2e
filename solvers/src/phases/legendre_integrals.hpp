#pragma once
#include <Eigen/Core>
#include <complex>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {

/// Legendre's polynomials P_0 to P_(count - 1) at points x in [-1, 1]: points x count. O(points count).
Eigen::MatrixXd legendre_values(const Eigen::VectorXd& points, Index count);

/// The integrals of exp(z (x - s)) P_k(s) over s from -1 to x, for k < count and points x in [-1, 1]: the
/// solutions of y' = z y + P_k with y(-1) = 0, for Re z <= 0, to a few units of rounding of the largest.
///
/// Integration by parts gives z y_(k-1) + (2 k + 1) y_k - z y_(k+1) = P_(k+1)(x) - P_(k-1)(x), whose solution
/// wanted neither grows nor decays with k below |z| and decays beyond. The recurrence is followed upwards
/// where that is stable, and beyond solved as a boundary value problem [F. W. J. Olver, J. Res. NBS 71B,
/// 1967].
class ExponentialIntegrals {
 public:
  ExponentialIntegrals(const Eigen::VectorXd& points, Index count);

  /// For one z. O(points (count + |z|)).
  void compute(std::complex<double> z);
  /// points x count.
  Eigen::Ref<const Eigen::MatrixXcd> values() const { return y_.leftCols(count_); }
  /// exp(z (x + 1)) at the points.
  const Eigen::VectorXcd& decay() const { return decay_; }

 private:
  void reserve(Index last);
  void solve_downwards(std::complex<double> z, Index from, Index last);

  Eigen::VectorXd points_;
  Index count_;
  Eigen::MatrixXd jumps_;  // points x K: P_(k+1) - P_(k-1) in column k
  Eigen::MatrixXcd y_;     // points x K
  Eigen::VectorXcd decay_, inverse_;
};

/// Gauss and Legendre's nodes on [-1, 1] and what leads from values there to Legendre coefficients.
struct LegendreNodes {
  explicit LegendreNodes(Index count);

  Index count() const { return points.size(); }
  Eigen::VectorXd points;        ///< q, ascending
  Eigen::MatrixXd coefficients;  ///< q x q: of values at the nodes
};

}  // namespace wavebalance::solvers::detail
