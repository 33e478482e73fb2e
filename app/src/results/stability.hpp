#pragma once
#include <string_view>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The fields of the stability of a `motion`, and a warning where it is unstable.
void append_stability(Record& record, const ResponseStability& stability,
                      std::string_view motion = "response");

/// The turning points of a sweep, its stability and its bifurcation and grazing points. Where stability is
/// known the turning points are folds of the motion; folds that only the samples have are reported
/// separately, with a warning.
void append_stability(Record& record, const Scene& scene, const Sweep& sweep);

/// The table `branches`, and a warning about each that was not followed to an end.
void append_branches(Record& record, const Sweep& sweep);
/// Whether isolated branches were searched for, and the table `isolas` of those found, with a warning about
/// each incomplete one.
void append_isolas(Record& record, const Scene& scene, const Sweep& sweep);

}  // namespace wavebalance::app
