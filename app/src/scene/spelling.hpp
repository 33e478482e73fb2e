#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavebalance::app {

/// The one of `names` that `word` was probably meant to be; empty if none is near. O(length^2) per name.
std::string closest(std::string_view word, const std::vector<std::string>& names);

/// "a, b, c".
std::string joined(const std::vector<std::string>& names);

}  // namespace wavebalance::app
