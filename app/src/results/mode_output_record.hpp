#pragma once
#include <vector>

#include "drawing/mode_figure.hpp"
#include "wavebalance/app/outputs/mode_outputs.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Adds the columns of the outputs to the record's backbone, which is complete but for its stability, and
/// what is known of each along the mode to its summary. Returns the outputs as pictures draw them.
std::vector<ModeOutput> append_outputs(Record& record, const Scene& scene, const ModeOutputs& outputs);

/// The first output; null if contacts are the only outputs.
const ModeOutput* leading_of(const std::vector<ModeOutput>& outputs, const Scene& scene);

/// Adds the picture of the outputs along a mode; none without any, and none of a single one that leads, which
/// the record's own figure draws.
void draw_outputs(Record& record, const Scene& scene, const std::vector<ModeOutput>& outputs,
                  const solvers::BackboneStability& stability = {});

}  // namespace wavebalance::app
