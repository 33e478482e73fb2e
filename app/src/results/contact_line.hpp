#pragma once
#include <cstdint>
#include <string>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// "1 mode", "8 modes".
std::string count_text(std::int64_t count, const std::string& what);

/// The line of a scene's contacts: their law, where they are, their gaps.
std::string contact_line(const Scene& scene);

}  // namespace wavebalance::app
