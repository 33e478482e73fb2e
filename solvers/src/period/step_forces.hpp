#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::solvers {

/// The end of a step without contact forces there, and what these change.
struct StepEnd {
  const Eigen::MatrixXd& compliance;  ///< D, C x C, m/N
  const Eigen::MatrixXd& mobility;    ///< B, C x C, m/s/N
  Eigen::VectorXd displacement;       ///< C, m
  Eigen::VectorXd velocity;           ///< C, m/s; empty where no law depends on it
  /// C, m, displacements at the start of the step, for laws with memory; empty: the end is at rest since
  /// ever.
  Eigen::VectorXd before;
};

/// The contact forces at the end of a step.
struct StepForces {
  Eigen::VectorXd force;  ///< C, N
  int evaluations = 0;    ///< of laws and resolvents
};

/// Contact forces f at the end of a step with f_c = law_c(displacement_c - (D f)_c, velocity_c - (B f)_c) by
/// Gauss-Seidel, each force by its resolvent for the flexibility D_cc. `begin` has those at the start of the
/// step.
StepForces step_forces(const ContactLaws& laws, const StepEnd& end, const Eigen::VectorXd& begin);

}  // namespace wavebalance::solvers
