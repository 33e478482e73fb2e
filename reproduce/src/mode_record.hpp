#pragma once
#include "wavebalance/reproduce/analysis.hpp"

namespace wavebalance::reproduce {

/// The record of a nonlinear mode: its curve, or the one motion of analysis.energy_ratio.
Record mode_record(const Scene& scene, const StructureModel& model, const ProgressObserver& observer);

}  // namespace wavebalance::reproduce
