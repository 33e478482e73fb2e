#pragma once

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers::testing {

/// Where the law holds, samples() values: the displacement, or v - f / epsilon in the force form.
inline Eigen::VectorXd held_motion(const CondensedProblem& problem, const PeriodicResponse& response) {
  Eigen::VectorXd held = response.unknown;
  for (Eigen::Index c = 0; c < response.series_flexibility.size(); ++c)
    held.segment(c * problem.points(), problem.points()) -=
        response.series_flexibility[c] *
        response.contact_force.segment(c * problem.points(), problem.points());
  return held;
}

}  // namespace wavebalance::solvers::testing
