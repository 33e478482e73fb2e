#pragma once

#include <string>
#include <vector>

#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/compose.hpp"

/// bar_scene with other values, each as "key=value".
inline wavebalance::app::Scene scene_of(const std::vector<std::string>& overrides = {}) {
  return wavebalance::app::parse_scene(bar_scene, "case.toml", overrides);
}
