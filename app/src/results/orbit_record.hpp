#pragma once
#include <vector>

#include "wavebalance/app/analysis/curve_motions.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Whether the motion of the whole structure is needed for the orbit in the plane of an unbalance.
bool has_unbalance_orbit(const Scene& scene);

/// Adds orbits.csv and a picture of y over x: in the plane of the first unbalance that has two rows, and of
/// each contact in a ring. Without effect on scenes that have neither, and on motions that are not known
/// there.
void append_orbits(Record& record, const Scene& scene, const StructureModel& model, const Response& response);
/// The same of the motions of points of a curve.
void append_orbits(Record& record, const Scene& scene, const std::vector<CurveMotion>& motions);

}  // namespace wavebalance::app
