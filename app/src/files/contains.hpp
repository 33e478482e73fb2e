#pragma once
#include <algorithm>

namespace wavebalance::app {

/// Whether a list holds a value.
bool contains(const auto& list, const auto& value) { return std::ranges::find(list, value) != list.end(); }

}  // namespace wavebalance::app
