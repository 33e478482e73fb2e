#pragma once
#include <string>

#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Whether the record has the motion of a bar, and a load to which its contact force is related.
bool has_bar_motion(const Scene& scene, const Record& record);

/// The motion as a script, `wavebalance.motions["name"] = {...}`, which motion.js of app/page moves: at each
/// instant the displacements of all nodes and of the tip (m) and the contact force over the amplitude of the
/// load. Values have 6 significant digits.
std::string bar_motion_script(const Scene& scene, const Record& record, const std::string& name);

}  // namespace wavebalance::app
