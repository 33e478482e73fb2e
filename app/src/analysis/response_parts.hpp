#pragma once
#include <string>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::app {

/// Copies what a solver says of a response into `result`, which has its motions from elsewhere.
void copy_solution(Response& result, solvers::CondensedProblem& problem,
                   const solvers::PeriodicResponse& found, const Scene& scene, const StructureModel& model);

/// `time` with the pair, functions and points that a response to a tolerance chose.
Time solved_time(Time time, const Response& response);

/// rms of `found` less `start` over that of `start`; NaN if that is empty.
double relative_distance(const Eigen::VectorXd& found, const Eigen::VectorXd& start);

/// The status of a result whose rounding error is above largest_rounding_error.
std::string inaccurate_status(double rounding_error);

}  // namespace wavebalance::app
