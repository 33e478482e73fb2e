#pragma once
#include <Eigen/Core>
#include <vector>

#include "phases/legendre_integrals.hpp"

namespace wavebalance::solvers::detail {

/// exp(z_r (x + 1)) of P poles on a cell, x in [-1, 1], and what polynomial forces there make of them. The
/// slow ones are sums of Legendre's polynomials, so that what many poles make together is one such sum; the
/// few fast ones are taken one by one.
class CellWaves {
 public:
  /// z: exponents times half the length of the cell, Re z <= 0. O(P (q^2 + |z|)).
  CellWaves(const Eigen::VectorXcd& z, const LegendreNodes& nodes);
  /// The same at N other points of the cell in place of the q nodes.
  CellWaves(const Eigen::VectorXcd& z, const LegendreNodes& nodes, const Eigen::VectorXd& points);

  const Eigen::VectorXcd& decay() const { return decay_; }        ///< P: exp(2 z)
  const Eigen::MatrixXcd& at_nodes() const { return at_nodes_; }  ///< q x P
  /// P x q: the integrals of exp(z (1 - s)) P_k(s) over the cell.
  const Eigen::MatrixXcd& at_end() const { return at_end_; }
  /// count x q: takes Legendre coefficients of a force to what the poles, weighted by w, make of it up to
  /// each of the nodes from `first` on: Re sum of w_r times the integral of exp(z_r (x - s)) f(s) over s from
  /// -1 to x. O(N q (q + P / q)).
  Eigen::MatrixXd up_to_nodes(const Eigen::VectorXcd& weights, Index first, Index count) const;

  /// For each pole, its integrals of exp(z_r (x - s)) P_k(s) over s from -1 to x at the nodes, N x q. z: as
  /// the constructor has it. O(N P q).
  std::vector<Eigen::MatrixXcd> integrals_of(const Eigen::VectorXcd& z) const;

  /// Legendre coefficients of Re sum w_r exp(z_r (x + 1)) over the slow poles.
  Eigen::VectorXd slow_series(const Eigen::VectorXcd& weights) const;
  Index series_length() const { return series_real_.rows(); }  ///< N
  const std::vector<Index>& fast() const { return fast_; }     ///< numbers of poles

 private:
  void sum_up(const Eigen::VectorXcd& z, const Eigen::VectorXd& points);
  const Eigen::MatrixXd& values() const { return own_points_ ? own_values_ : nodes_.values; }
  template <class Scalar>
  void add_fast(Index pole, Scalar z, ExponentialIntegrals<Scalar>& integrals);

  const LegendreNodes& nodes_;
  Eigen::VectorXd points_;  // of the nodes
  bool own_points_ = false;
  Eigen::MatrixXd own_values_;  // Legendre's polynomials at points of its own
  Eigen::VectorXcd decay_;
  Eigen::MatrixXcd at_nodes_, at_end_;
  Eigen::MatrixXd series_real_, series_imag_;  // N x P, zero for fast poles
  std::vector<Index> fast_;
  struct Integrals {
    Eigen::MatrixXd real, imag;  // q x q; imag is empty where z is real
  };
  std::vector<Integrals> fast_integrals_;
};

}  // namespace wavebalance::solvers::detail
