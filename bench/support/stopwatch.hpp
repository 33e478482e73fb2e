#pragma once
#include "wavebalance/app/compare/stopwatch.hpp"

namespace wavebalance::bench {

using app::least_seconds;
using app::processor_seconds;
using app::Repetition;
using app::TimeLimit;

}  // namespace wavebalance::bench
