#pragma once
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The record of a nonlinear mode with friction: its curve, or the one motion of analysis.amplitude_ratio.
Record damped_mode_record(const Scene& scene, const StructureModel& model, const Observer& observer);

}  // namespace wavebalance::app
