#pragma once
#include <Eigen/Core>

#include "period_oracle/shooting_modes.hpp"

namespace wavebalance::oracle {

/// Propagates the deviation y = (q, q') of the modal state from the response without contact over steps of
/// one length h, exactly in the linear part: with the contact force a polynomial through its values at Gauss
/// nodes,
///   y(end) = transition y + end_force f,   u_c(nodes) = u_linear(nodes) + node_state y + node_force f.
struct StepTable {
  static constexpr int nodes = 6;
  using NodeMatrix = Eigen::Matrix<double, nodes, nodes>;
  using NodeVector = Eigen::Matrix<double, nodes, 1>;

  static const NodeVector& points();    ///< the Gauss points of [0, 1]
  static const NodeVector& at_begin();  ///< polynomial at 0 = at_begin . its values at the points
  static const NodeVector& at_end();    ///< the same at 1

  StepTable(const ModalStructure& modes, double step_seconds);

  Eigen::VectorXd from_q_to_q, from_v_to_q;  // n each: the transition's diagonal blocks
  Eigen::VectorXd from_q_to_v, from_v_to_v;
  Eigen::Matrix<double, nodes, Eigen::Dynamic> node_state;  // nodes x 2n
  NodeMatrix node_force;                                    // m/N
  Eigen::Matrix<double, Eigen::Dynamic, nodes> end_force;   // 2n x nodes
};

}  // namespace wavebalance::oracle
