#pragma once
#include <limits>

namespace wavebalance::app {

/// A number that is not known or has no meaning; null in summary.json and "nan" in tables.
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace wavebalance::app
