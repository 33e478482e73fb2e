#pragma once
#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// `time` with the pair, functions and points that a response to a tolerance chose.
Time solved_time(Time time, const Response& response);

}  // namespace wavebalance::app
