#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/newton.hpp"

namespace wavebalance::solvers::detail {

/// How a continuation in the stiffness of the contacts ended.
struct StiffnessPath {
  SolveStatus status = SolveStatus::stalled;  ///< converged where the whole force was reached
  int iterations = 0;                         ///< of Newton's method
};

/// Follows R(u; s) = u - u0 + s K f(u) in the displacement form from the linear response u0, s = 0, to s =
/// 1, by Newton's method at growing fractions s of the contact force, each from the previous solution. The
/// first fraction is such that the contacts move the structure by about half of u0, and each is up to 16
/// times the one before: the samples in contact change with the logarithm of the stiffness, so that a path
/// needs some twenty iterations for any number of contacts. `u` becomes the last solution. The system is
/// left with the whole force.
StiffnessPath follow_stiffness(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options);

}  // namespace wavebalance::solvers::detail
