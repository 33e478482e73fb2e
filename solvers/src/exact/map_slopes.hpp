#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/flow/contact_flow.hpp"

namespace wavebalance::solvers::detail {

/// How the state after a period depends on that at its beginning and on the parameter. The position of a
/// slider that stays at rest, which the motion does not determine, follows the middle of those in which it
/// does.
struct MapSlopes {
  Eigen::MatrixXd map;
  Eigen::VectorXd by_parameter;
  Eigen::VectorXcd multipliers;
  std::vector<Eigen::Index> rest;  ///< numbers of the states that are positions of sliders which stay at rest
  Eigen::MatrixXd middles;         ///< how their distances from the middle change by these positions

  /// The change of state and parameter that leaves `right` of x - P and `held_right` of the plane held.
  Eigen::VectorXd step(const Eigen::VectorXd& held, const Eigen::VectorXd& right, double held_right) const;
  /// The residual after a step updates the matrix [C. G. Broyden, Math. Comp. 19, 1965]; `plane`:
  /// perpendicular to the step.
  void learn(const Eigen::VectorXd& left, const Eigen::VectorXd& step, const Eigen::VectorXd& plane);
  /// How the free states follow positions of sliders at rest and, in the last column, the parameter, so that
  /// they come back.
  Eigen::MatrixXd moves_that_return(const std::vector<Eigen::Index>& free) const;
};

/// Numbers of the states that a map leaves as they are: positions of sliders which stay at rest.
std::vector<Eigen::Index> at_rest(const Eigen::MatrixXd& map);

/// m, by which such sliders lie in front of the middle after the last period.
Eigen::VectorXd off_center(const ContactFlow& flow, const std::vector<Eigen::Index>& rest);

}  // namespace wavebalance::solvers::detail
