#pragma once
#include <string>

#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// `time` with the pair, functions and points that a response to a tolerance chose.
Time solved_time(Time time, const Response& response);

/// The status of a result whose rounding error is above largest_rounding_error.
std::string inaccurate_status(double rounding_error);

}  // namespace wavebalance::app
