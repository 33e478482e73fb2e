#pragma once
#include <cstddef>
#include <vector>

namespace wavebalance::app {

/// Numbers of the points that a curve keeps: those between which every other point lies within `tolerance` of
/// the straight line (Douglas & Peucker, 1973). Points that are not finite interrupt the curve; one of them
/// is kept at each interruption. `x` and `y` have one length. O(n log n) operations as a rule.
std::vector<std::size_t> kept_points(const std::vector<double>& x, const std::vector<double>& y,
                                     double tolerance);

}  // namespace wavebalance::app
