#pragma once
#include "wavebalance/app/analysis/whirl.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// Whirl frequencies over the speed by their direction, the line on which both are equal, and the critical
/// speeds on it.
Figure campbell_figure(const CampbellDiagram& diagram);

}  // namespace wavebalance::app
