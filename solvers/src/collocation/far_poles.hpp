#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {

/// Poles that are so fast in a cell that a force which is a polynomial there makes of each the polynomial p
/// of the same degree with p' = z p + f, and y = p + (y(-1) - p(-1)) exp(z (x + 1)), x in [-1, 1]. The
/// Legendre coefficients of p follow from the last to the first.
class FarPoles {
 public:
  /// Legendre coefficients of complex polynomials, poles x q, and their values at -1.
  struct Series {
    Eigen::MatrixXd real, imag;
    Eigen::VectorXcd at_begin;
  };

  /// exp(z (x + 1)) at points x, points x P; `imag` is empty where all z are real.
  struct Decay {
    Eigen::MatrixXd real, imag;

    Eigen::VectorXcd column(Index pole) const;
    /// Re of these times complex states.
    Eigen::VectorXd times(const Eigen::VectorXcd& states) const;
  };

  FarPoles() = default;
  /// z: exponents times half the length of the cell. Forces have q = `count` coefficients.
  FarPoles(const Eigen::VectorXcd& z, Index count);

  /// P x q: the values at -1 and at 1 of the polynomials that P_k makes.
  const Eigen::MatrixXcd& at_begin() const { return at_begin_; }
  const Eigen::MatrixXcd& at_end() const { return at_end_; }
  Decay decay(const Eigen::VectorXd& points) const;
  /// q x q: maps the Legendre coefficients of a force to the coefficients of Re sum w_r p_r. O(P q^2).
  Eigen::MatrixXd polynomials(const Eigen::VectorXcd& weights) const;
  /// The response of each pole to forces, P x q. O(P q).
  Series solve(const Eigen::MatrixXd& real, const Eigen::MatrixXd& imag) const;

 private:
  Eigen::VectorXcd z_;
  Eigen::ArrayXd inverse_real_, inverse_imag_;  // 1 / z
  Eigen::MatrixXcd at_begin_, at_end_;
};

}  // namespace wavebalance::solvers::detail
