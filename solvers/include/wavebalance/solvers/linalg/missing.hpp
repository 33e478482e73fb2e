#pragma once
#include <limits>

namespace wavebalance::solvers {

/// The value of a number that is not known or not applicable.
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace wavebalance::solvers
