#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// One period of a motion at the uniform times l T / points, l = 0..points-1, where T is the period and the
/// load is cos(2 pi l / points).
struct PeriodSamples {
  Eigen::VectorXd displacement;   ///< points, m, contact degree of freedom
  Eigen::VectorXd velocity;       ///< points, m/s, contact degree of freedom
  Eigen::VectorXd contact_force;  ///< points, N
  Eigen::MatrixXd displacements;  ///< n x points, m, or empty when the full history was not asked for
  Eigen::MatrixXd velocities;     ///< n x points, m/s, or empty when the full history was not asked for

  int points() const { return static_cast<int>(displacement.size()); }
};

}  // namespace wavebalance::solvers
