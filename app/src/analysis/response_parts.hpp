#pragma once
#include <string>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::app {

/// Sets what `result` says of a response of a scene's problem, motions apart.
void note_solution(Response& result, solvers::CondensedProblem& problem,
                   const solvers::PeriodicResponse& found, const Scene& scene, const StructureModel& model);

/// `time` with the pair, functions and points that a response to a tolerance chose.
Time solved_time(Time time, const Response& response);

/// The status of a result whose rounding error is above largest_rounding_error.
std::string inaccurate_status(double rounding_error);

}  // namespace wavebalance::app
