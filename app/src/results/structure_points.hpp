#pragma once
#include <optional>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The table of the bifurcation points of a balance with two columns more: the frequency or amplitude of the
/// structure's next to each, NaN where there is none, and solvers::StructurePointStatus.
Table with_structure_points(std::vector<Summary> special_points, const Sweep& sweep);

/// The folds of the structure in the order of its curve, where this was followed as a whole.
std::optional<std::vector<double>> structure_folds(const Sweep& sweep);

/// The table of the exact bifurcation points along a sweep, and warnings where the balance has others and
/// where it misses part of the structure's curve. Nothing if not requested.
void append_structure_points(Record& record, const Sweep& sweep);

/// The parts of a sweep, its branches and its isolas whose motions are unstable, in their order: `branch` (0
/// of the main curve), where each begins and ends, and with isolas `isola` (0 of the sweep). That is the
/// fold, period doubling or other point at which the multipliers pass the unit circle, of the structure where
/// its whole curve is known; a part without one begins or ends at its own first or last point.
Table unstable_parts(const Sweep& sweep);

}  // namespace wavebalance::app
