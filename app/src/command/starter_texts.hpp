#pragma once
#include <string>
#include <utility>
#include <vector>

namespace wavebalance::app {

/// Scenes to start from by their kind, and a study of STEM_scene.toml, as CMake finds them in starters/.
/// STEM is the stem of their files.
const std::vector<std::pair<std::string, std::string>>& starter_texts();

}  // namespace wavebalance::app
