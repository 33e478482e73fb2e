#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::oracle {

/// The periodic response against a rigid obstacle of a structure whose last degree of freedom touches and has
/// no mass, so that closing transfers no impulse: two linear flows, free and closed, joined at the instants
/// where the tip reaches the gap and where the force falls to zero.
struct RigidReference {
  bool converged = false;
  int periods = 0;
  double change = 0.0;            ///< of the state over the last period, relative
  Eigen::VectorXd displacement;   ///< m, `points` uniform samples of the tip
  Eigen::VectorXd contact_force;  ///< N, the same
  std::vector<double> instants;   ///< fractions of the period at which contact closes and opens
};

/// Both flows are advanced by matrix exponentials, exact to rounding, and the instants found by bisection to
/// 2^-32 of a sample; periods are run until the state repeats to `tolerance`. Contact shorter than a sample
/// can be missed. Load amplitude times cos(2 pi f t). Throws std::invalid_argument unless the last degree of
/// freedom touches, has no mass and is damped. O(points n^2) a period, 66 exponentials beside.
RigidReference rigid_reference(const solvers::LinearStructure& structure, double gap, double frequency_hz,
                               int points, double tolerance = 1e-11, int max_periods = 1000);

}  // namespace wavebalance::oracle
