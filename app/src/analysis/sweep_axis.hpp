#pragma once
#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::app {

SweepAxis sweep_axis(const Sweep& sweep);

}  // namespace wavebalance::app
