#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The record of analysis.type = "limit_cycle": that of a response at the frequency of the cycle, with its
/// period, its multipliers, and what became of the starts.
Record limit_cycle_record(const Scene& scene, const StructureModel& model, ResponseOptions options);

}  // namespace wavebalance::app
