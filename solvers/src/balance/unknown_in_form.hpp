#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers::detail {

/// The unknown of a displacement (m) and its contact force (N, empty where none is known): u in the
/// displacement form, u + f / epsilon in the force form, see ContactOperator. O(C N).
inline Eigen::VectorXd unknown_in_form(Eigen::VectorXd displacement, const Eigen::VectorXd& force,
                                       const Eigen::VectorXd& series_flexibility) {
  if (force.size() == 0 || series_flexibility.size() == 0) return displacement;
  const Eigen::Index points = displacement.size() / series_flexibility.size();
  for (Eigen::Index c = 0; c < series_flexibility.size(); ++c)
    displacement.segment(c * points, points) += series_flexibility[c] * force.segment(c * points, points);
  return displacement;
}

}  // namespace wavebalance::solvers::detail
