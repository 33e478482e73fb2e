#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "collocation/far_poles.hpp"
#include "collocation/legendre_integrals.hpp"

namespace wavebalance::solvers::detail {

/// exp(z_r (x + 1)) of P poles on a cell, x in [-1, 1], and what polynomial forces there leave of them at its
/// end. The slow ones are sums of Legendre's polynomials, so that what many poles make together is one such
/// sum. The far ones make polynomials of a polynomial force. The few fast ones between are taken one by one.
class CellWaves {
 public:
  /// z: exponents times half the length of the cell, Re z <= 0. Forces have q = `count` coefficients.
  /// O(P (q + |z|)).
  CellWaves(Eigen::VectorXcd z, Index count);

  const Eigen::VectorXcd& z() const { return z_; }
  Index count() const { return at_end_.cols(); }            ///< q
  const Eigen::VectorXcd& decay() const { return decay_; }  ///< P: exp(2 z)
  /// P x q: the integrals of exp(z (1 - s)) P_k(s) over the cell.
  const Eigen::MatrixXcd& at_end() const { return at_end_; }
  /// Legendre coefficients of Re sum w_r exp(z_r (x + 1)) over the slow poles.
  Eigen::VectorXd slow_series(const Eigen::VectorXcd& weights) const;
  Index series_length() const { return series_real_.rows(); }  ///< N
  const std::vector<Index>& fast() const { return fast_; }     ///< numbers of poles
  const std::vector<Index>& far() const { return far_; }
  const FarPoles& far_poles() const { return far_poles_; }
  const std::vector<Index>& slow() const { return slow_; }
  /// N x slow poles: Legendre coefficients of each exp(z (x + 1)).
  const Eigen::MatrixXd& series_real() const { return series_real_; }
  const Eigen::MatrixXd& series_imag() const { return series_imag_; }

 private:
  void set_slow();
  void set_far();

  Eigen::VectorXcd z_, decay_;
  Eigen::MatrixXcd at_end_;
  Eigen::MatrixXd series_real_, series_imag_;
  std::vector<Index> slow_, fast_, far_;
  FarPoles far_poles_;
};

/// The same at points of the cell. Keeps references to both arguments.
class WavesAtNodes {
 public:
  /// At all q nodes. O(q (q + |z|)) for each fast pole.
  WavesAtNodes(const CellWaves& waves, const LegendreNodes& nodes);
  /// At N other points in their place.
  WavesAtNodes(const CellWaves& waves, const LegendreNodes& nodes, const Eigen::VectorXd& points);

  Eigen::MatrixXcd values() const;  ///< q x P. O(N P q)
  /// States of a fast pole at the nodes, from a state at the beginning and a force with these Legendre
  /// coefficients. `number` counts CellWaves::fast(). O(q^2).
  Eigen::VectorXcd states(std::size_t number, std::complex<double> start,
                          const Eigen::VectorXcd& force) const;
  const FarPoles::Decay& far_decay() const { return far_decay_; }
  /// q x K: Legendre's polynomials at the nodes.
  const Eigen::MatrixXd& polynomials() const { return own_points_ ? own_values_ : nodes_.values; }
  /// count x q: maps Legendre coefficients of a force to the response of the poles, weighted by w, at each
  /// of the nodes from `first` on: Re sum of w_r times the integral of exp(z_r (x - s)) f(s) over s from -1
  /// to x. O(N q (q + P / q)).
  Eigen::MatrixXd up_to(const Eigen::VectorXcd& weights, Index first, Index count) const;
  /// For each pole, its integrals of exp(z_r (x - s)) P_k(s) over s from -1 to x at the nodes, N x q. O(N P
  /// q).
  std::vector<Eigen::MatrixXcd> integrals() const;

 private:
  void integrate_fast();
  template <class Scalar>
  void add_fast(Scalar z, ExponentialIntegrals<Scalar>& integrals);

  const CellWaves& waves_;
  const LegendreNodes& nodes_;
  Eigen::VectorXd points_;  // of the nodes
  bool own_points_ = false;
  Eigen::MatrixXd own_values_;  // Legendre polynomials at given points
  struct Integrals {
    Eigen::MatrixXd real, imag;  // q x q; imag is empty where z is real
    Eigen::VectorXcd decay;
  };
  std::vector<Integrals> fast_integrals_;
  FarPoles::Decay far_decay_;
};

}  // namespace wavebalance::solvers::detail
