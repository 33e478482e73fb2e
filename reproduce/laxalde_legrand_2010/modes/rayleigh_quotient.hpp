#pragma once
#include <Eigen/Core>

namespace wavebalance::ll10 {

/// The form x^T A x = sum_b factor_b x_b^T S x_b over the blocks x_b (n entries each) of x, one matrix S.
class HarmonicForm {
 public:
  /// matrix: n x n symmetric; factors: one per block. Throws std::invalid_argument if the matrix is not
  /// square.
  HarmonicForm(Eigen::MatrixXd matrix, Eigen::VectorXd factors);

  Eigen::Index size() const { return matrix_.rows() * factors_.size(); }
  double value(const Eigen::VectorXd& x) const { return x.dot(apply(x)); }
  /// A x. O(n^2 blocks).
  Eigen::VectorXd apply(const Eigen::VectorXd& x) const;
  /// target += scale A. O(n^2 blocks).
  void add_to(Eigen::MatrixXd& target, double scale) const;

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd factors_;
};

/// The real Fourier coefficients of a motion of n degrees of freedom,
///   u(t) = a_0 + sum_{n=1..N} (a_n cos n omega t + b_n sin n omega t),   x = [a_0; a_1; b_1; ...; a_N; b_N]
/// or, for motions even in time, x = [a_0; a_1; ...; a_N]. Period means are sums with w_0 = 1, w_n = 1/2.
struct FourierLayout {
  int harmonics = 1;  ///< N >= 1
  bool cosine_only = false;

  int blocks() const { return 1 + harmonics * (cosine_only ? 1 : 2); }
  int harmonic(int block) const { return cosine_only ? block : (block + 1) / 2; }
  bool is_sine(int block) const { return !cosine_only && block > 0 && block % 2 == 0; }
  double weight(int block) const { return block == 0 ? 1.0 : 0.5; }
  /// w_b n_b^power for all blocks (0^0 = 1).
  Eigen::VectorXd factors(int power) const;
};

/// The generalised Rayleigh quotient of a periodic motion [LL10, eqs. (10), (11), (24a)]
///   r(x) = k(x) / m(x),   k = sum_b w_b x_b^T K x_b,   m = sum_b w_b n_b^2 x_b^T M x_b,
/// m with n^2. r(c x) = r(x), so that x . grad r = 0. A motion with all energy in harmonic n has 1/n^2 of its
/// quotient in harmonic 1: the modes are critical points, not minima. Immutable.
class RayleighQuotient {
 public:
  /// stiffness, mass: n x n symmetric. Throws std::invalid_argument if the sizes differ or N < 1.
  RayleighQuotient(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, FourierLayout layout);

  const FourierLayout& layout() const { return layout_; }
  Eigen::Index unknowns() const { return stiffness_.size(); }
  const HarmonicForm& stiffness() const { return stiffness_; }  ///< k, whose matrix is A below
  const HarmonicForm& mass() const { return mass_; }            ///< m with n^2, matrix D

  /// (rad/s)^2. Infinite or not a number for a motion at rest, as are the derivatives. O(n^2 N).
  double value(const Eigen::VectorXd& x) const;
  /// (2/m) (A - r D) x.
  Eigen::VectorXd gradient(const Eigen::VectorXd& x) const;
  /// (2/m) (A - r D - grad r (D x)^T - D x grad r^T), dense. O((n N)^2).
  Eigen::MatrixXd hessian(const Eigen::VectorXd& x) const;

 private:
  FourierLayout layout_;
  HarmonicForm stiffness_, mass_;
};

}  // namespace wavebalance::ll10
