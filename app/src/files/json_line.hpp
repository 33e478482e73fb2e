#pragma once
#include <optional>

#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

/// `summary` as JSON on one line without its end; numbers that are not finite become null.
std::string json_line(const Summary& summary);

/// The numbers, truth values and texts of a JSON object, in its order; null as NaN, lists and tables left
/// out. None if it is no JSON object.
std::optional<Summary> parse_summary(std::string_view text);

}  // namespace wavebalance::app
