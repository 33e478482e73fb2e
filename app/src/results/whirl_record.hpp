#pragma once
#include <string>

#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Adds the critical speeds of a structure that turns to the summary, and its Campbell diagram from rest to
/// the end of the sweep as campbell.csv and a picture. Without effect on other structures and analyses.
void append_whirls(Record& record, const Scene& scene, const StructureModel& model);

/// The lines of describe_scene() on the whirls at the speed of the scene, or at both ends of its sweep, and
/// on critical speeds; empty for other structures.
std::string whirl_lines(const Scene& scene);

}  // namespace wavebalance::app
