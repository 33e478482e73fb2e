#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers::detail {

/// The unknown of a displacement (m) and its contact force (N, empty where none is known): u in the
/// displacement form, u + f / epsilon in the force form, see ContactOperator. O(C N).
inline Eigen::VectorXd unknown_in_form(Eigen::VectorXd displacement, const Eigen::VectorXd& force,
                                       const Eigen::VectorXd& regularization) {
  if (force.size() == 0 || regularization.size() == 0) return displacement;
  const Eigen::Index points = displacement.size() / regularization.size();
  for (Eigen::Index c = 0; c < regularization.size(); ++c)
    displacement.segment(c * points, points) += regularization[c] * force.segment(c * points, points);
  return displacement;
}

}  // namespace wavebalance::solvers::detail
