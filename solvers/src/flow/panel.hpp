#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "collocation/legendre_integrals.hpp"
#include "flow/contact_poles.hpp"
#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {

/// q, of all panels.
inline constexpr Index panel_nodes = 12;

/// Values of poles and forces at q nodes, evaluated at N points of a panel [t, t + 2 h]: exp(r h (x + 1)),
/// P x N, of each pole the response to node forces, N x q, s, and the first derivatives by time of the
/// forces, N x q, 1/s^k.
struct PoleWaves {
  PoleWaves(const ContactPoles& poles, const LegendreNodes& nodes, double half,
            const Eigen::VectorXd& points);

  Eigen::VectorXd points;
  Eigen::MatrixXcd decay;
  std::vector<Eigen::MatrixXcd> driven;
  std::array<Eigen::MatrixXd, kinds - force_kind> forces;
};

/// Panels of one length: time [t, t + 2 h] in which the forces of R rows are polynomials through q Gauss
/// nodes, R x q. The motion is then exact. Immutable but for influences, which are computed once.
class PanelShape {
 public:
  /// Points: the nodes, the end, then `dense`.
  PanelShape(const ContactPoles& poles, const LegendreNodes& nodes, double half,
             const Eigen::VectorXd& dense);

  double half() const { return half_; }  ///< s
  Index nodes() const { return nodes_.count(); }
  const PoleWaves& waves() const { return waves_; }
  /// Rq x Rq, row a q + n and column b q + m: the derivative of a level 0 to 2 at node n of row a by the
  /// force at node m of row b.
  const Eigen::MatrixXd& influence(int level) const;
  /// The forces at the beginning of a panel by those at its nodes, q.
  Eigen::VectorXd at_begin() const;
  /// Integrals from the beginning to points by values at the nodes, N x q, s.
  Eigen::MatrixXd integrals(const Eigen::VectorXd& points) const;
  /// The share of the two last Legendre coefficients in the largest force, which shows whether the nodes
  /// resolve it; `size` (N) is the least that counts.
  double unresolved(const Eigen::MatrixXd& force, double size) const;

 private:
  const ContactPoles& poles_;
  const LegendreNodes& nodes_;
  double half_;
  PoleWaves waves_;
  mutable std::array<std::optional<Eigen::MatrixXd>, 3> influence_;
};

/// Forces, R x q, N, and rates of memories, M x q, m/s, at the nodes of a panel.
struct NodeValues {
  Eigen::MatrixXd force, memory_rate;
};

/// Solves with a matrix whose factors are kept: linear laws have one on all panels of a length between
/// events.
class KeptFactor {
 public:
  /// x with matrix x = right. Contacts that hold each other, as a stop and a stuck slider at one mass, leave
  /// it undetermined: the smallest is returned.
  Eigen::MatrixXd solve(Eigen::MatrixXd matrix, const Eigen::MatrixXd& right);

 private:
  Eigen::MatrixXd matrix_;
  Lu<double> factor_;
};

/// The motion on a panel of a shape that begins at a time with states of the poles, P, and memories, M.
struct PanelMotion {
  const ContactPoles& poles;
  const PanelShape& shape;
  double begin;  ///< s
  const Eigen::VectorXcd& state;
  const std::vector<double>& memory;
  KeptFactor& factor;

  /// Signals at the points of waves; law forces have the force of the holding springs back.
  Signals at(const PoleWaves& waves, const NodeValues& values) const;
  /// The states at point k of waves.
  Eigen::VectorXcd state_at(const PoleWaves& waves, Index k, const Eigen::MatrixXd& force) const;
};

}  // namespace wavebalance::solvers::detail
