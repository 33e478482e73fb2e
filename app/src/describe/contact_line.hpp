#pragma once

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// The line of a scene's contacts: their law, where they are, their gaps.
std::string contact_line(const Scene& scene);

}  // namespace wavebalance::app
