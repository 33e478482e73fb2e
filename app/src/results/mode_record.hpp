#pragma once
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The record of a nonlinear mode: its curve, or the one motion of analysis.energy_ratio.
Record mode_record(const Scene& scene, const StructureModel& model, const Observer& observer);

}  // namespace wavebalance::app
