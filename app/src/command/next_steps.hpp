#pragma once
#include <string>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What to try where an analysis of this type ended with `status`, naming the keys; empty if nothing is
/// known. `exact`: of a curve by contact phases.
std::string next_step(AnalysisType type, const std::string& status, bool exact = false);

}  // namespace wavebalance::app
