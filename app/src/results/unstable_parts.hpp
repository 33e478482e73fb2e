#pragma once
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// The parts of a sweep, its branches and its isolas whose motions are unstable, in their order: `branch` (0
/// of the main curve), where each begins and ends, and with isolas `isola` (0 of the sweep). That is the
/// fold, period doubling or other point at which the multipliers pass the unit circle, of the structure where
/// its whole curve is known; a part without one begins or ends at its own first or last point.
Table unstable_parts(const Sweep& sweep);

}  // namespace wavebalance::app
