#pragma once
#include <string>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// `scene` as the text of a scene file with units as comments; loading it gives an equal scene. Keys that are
/// not allowed for the scene's contact law or analysis are left out.
std::string write_scene(const Scene& scene);

}  // namespace wavebalance::app
