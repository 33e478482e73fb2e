#pragma once
#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// The motion of all contacts at `points` uniform times; contact forces, which are known at the quadrature
/// points only, are those of the nearest ones.
ContactMotion motion_with_nearest_forces(const solvers::CondensedProblem& problem,
                                         const solvers::PeriodicResponse& response, int points);

/// `time` with the pair, functions and points that a response to a tolerance chose.
Time solved_time(Time time, const Response& response);

}  // namespace wavebalance::app
