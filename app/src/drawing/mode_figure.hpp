#pragma once
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::app {

/// Frequency over energy, unstable parts dashed, with the special points.
void draw_stability(Figure& figure, const Table& backbone, const ModeStudy& study,
                    const solvers::BackboneStability& stability);

}  // namespace wavebalance::app
