#pragma once
#include <functional>
#include <string>

#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

/// As describe_scene_keys(), of the keys, also those of pairs and terms, for which `shown` is true.
std::string describe_scene_keys(const std::function<bool(const SceneKey&)>& shown, int width = 100);

}  // namespace wavebalance::app
