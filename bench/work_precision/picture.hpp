#pragma once
#include <vector>

#include "points.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::bench {

/// Adds a panel of error over solve time: the front over everything, what Fourier:Fourier and the four pairs
/// with the most points on the front reach at best, collocation and the baselines. Points that have not
/// converged are not drawn.
void add_panel(app::Figure& figure, const Study& study, const std::vector<Point>& points);

}  // namespace wavebalance::bench
