#pragma once
#include <string_view>

namespace wavebalance::app {

/// The first line, from 1, at which a dotted key or a table's name has more than `max_parts` parts; 0 if
/// there is none. Each part is a table inside the one before, which the TOML library frees by recursion.
/// O(size).
int line_of_long_key(std::string_view text, int max_parts);

}  // namespace wavebalance::app
