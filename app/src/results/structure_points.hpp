#pragma once
#include <optional>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The table of the special points of a balance with two columns more: the frequency or amplitude of the
/// structure's next to each, NaN where there is none, and solvers::StructurePointStatus.
Table with_structure_points(const Table& special_points, const Sweep& sweep);

/// The folds of the structure in the order of its curve, where this was followed as a whole.
std::optional<std::vector<double>> structure_folds(const Sweep& sweep);

/// The table of the special points of the structure along a sweep, and warnings where the balance has others
/// and where it misses part of the structure's curve. Nothing where they were not sought.
void append_structure_points(Record& record, const Sweep& sweep);

}  // namespace wavebalance::app
