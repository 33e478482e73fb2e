#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// One period of a motion at the uniform times l T / points, l = 0..points-1, where T is the period and the
/// load is cos(2 pi l / points).
struct PeriodSamples {
  Eigen::VectorXd displacement;   ///< contacts x points, contact-major, m
  Eigen::VectorXd velocity;       ///< the same, m/s
  Eigen::VectorXd contact_force;  ///< the same, N
  Eigen::MatrixXd displacements;  ///< n x points, m, empty without full_history
  Eigen::MatrixXd velocities;     ///< n x points, m/s, empty without full_history

  int contacts = 1;

  int points() const { return static_cast<int>(displacement.size()) / contacts; }
};

}  // namespace wavebalance::solvers
