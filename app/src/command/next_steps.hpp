#pragma once
#include <string>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What to try where an analysis of this type ended with `status`, naming the keys; empty if nothing is
/// known.
std::string next_step(AnalysisType type, const std::string& status);

}  // namespace wavebalance::app
