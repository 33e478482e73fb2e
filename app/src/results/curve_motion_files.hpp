#pragma once
#include <vector>

#include "wavebalance/app/analysis/curve_motions.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The files and pictures of the motions of a sweep, their table `motions` in the summary, their instants of
/// contact where these are known, and a warning for each place
/// without one and each motion that was not solved for.
void append_motions(Record& record, const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const std::vector<CurveMotion>& motions);

}  // namespace wavebalance::app
