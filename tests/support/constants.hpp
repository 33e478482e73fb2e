#pragma once
#include <limits>
#include <numbers>

namespace wavebalance {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double two_pi = 2.0 * std::numbers::pi;

}  // namespace wavebalance
