#pragma once
#include <cstddef>
#include <vector>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// Numbers of the points that a curve keeps: those between which every other point lies within `tolerance` of
/// the straight line (Douglas & Peucker, 1973). Points that are not finite interrupt the curve; one of them
/// is kept at each interruption. `x` and `y` have one length. O(n log n) operations as a rule.
std::vector<std::size_t> kept_points(const std::vector<double>& x, const std::vector<double>& y,
                                     double tolerance);

/// Points drawn of a series of more than 8192 points: the first, lowest, highest and last of each of 2048
/// runs of neighbours, in their order. gnuplot takes minutes for millions of points, and kept_points() may
/// keep all of a curve that oscillates. Shorter series are returned as they are. O(n).
Series extremes_of_runs(const Series& series);

}  // namespace wavebalance::app
