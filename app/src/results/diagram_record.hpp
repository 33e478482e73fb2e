#pragma once
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The record of analysis.type = "bifurcation_diagram": its points as the table `section`, intervals of equal
/// period and of hysteresis in the summary, and the exact curve in exact_curve.csv.
Record diagram_record(const Scene& scene, const StructureModel& model, const Observer& observer);

}  // namespace wavebalance::app
