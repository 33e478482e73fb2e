#pragma once
#include <limits>

namespace wavebalance::solvers {

/// The value of a number that is not known or has no meaning where it stands.
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace wavebalance::solvers
