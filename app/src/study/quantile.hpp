#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wavebalance::app {

/// The value that a share 0..1 of ordered values does not exceed, linear between them (type 7 of Hyndman and
/// Fan 1996). There must be one value at least. O(1).
inline double quantile_of(const std::vector<double>& ordered, double share) {
  const double place = share * static_cast<double>(ordered.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ordered.size() - 1);
  return std::lerp(ordered[below], ordered[above], place - static_cast<double>(below));
}

}  // namespace wavebalance::app
