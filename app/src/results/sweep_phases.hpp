#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The columns of phases_cells().
std::vector<std::string> phases_columns();
/// The errors of a point and the status of its phases.
std::vector<Cell> phases_cells(const SweepPhases::Point& point);

/// Of the peak the errors and the status, with phases at all points the largest errors and how many points
/// have a motion of the structure near; a warning names the points that have none.
void append_phases(Record& record, const Sweep& sweep);

}  // namespace wavebalance::app
