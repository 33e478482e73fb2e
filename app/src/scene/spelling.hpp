#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavebalance::app {

/// The name here of what other programs call `word`, as a key of a section or as the value of a key: for
/// "time" and "harmonics" it is "functions = 2 x harmonics + 1", for "law" and "penalty" "linear". Empty
/// where none is known.
std::string_view name_for(std::string_view place, std::string_view word);

/// The one of `names` that `word` was probably meant to be; empty if none is near. O(length^2) per name.
std::string closest(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean NAME?" with the closest of `names`, or `otherwise` where none is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& names,
                       const std::string& otherwise = "");

/// "a, b, c".
std::string joined(const std::vector<std::string>& names);

}  // namespace wavebalance::app
