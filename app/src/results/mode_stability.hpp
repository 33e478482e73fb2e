#pragma once
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::app {

/// The columns `unstable`, missing where it is not known, and `contacts` of a backbone_table() of the same
/// points, whose first rows are the linear ones. Without effect where there is no stability.
void add_stability(Table& table, const solvers::BackboneStability& stability);

/// The fields of a curve's stability.
void append_stability(Summary& summary, const ModeStudy& study, const solvers::BackboneStability& stability);

/// Those of one motion, and a warning where it is unstable.
void append_stability(Record& record, const ModeStudy& study, const solvers::ModePoint& point);

}  // namespace wavebalance::app
