#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The record of analysis.type = "motions": the table `motions` in the summary, and the files of each.
Record motions_record(const Scene& scene, const StructureModel& model, const Observer& observer);

}  // namespace wavebalance::app
