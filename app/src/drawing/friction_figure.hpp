#pragma once
#include "drawing/period_window.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Adds the loops of friction force over tangential displacement of the contacts that dissipate most, and a
/// map of what each contact does over the period. Nothing without friction.
void add_friction(Figure& figure, const Scene& scene, const Response& response, const PeriodWindow& window);

}  // namespace wavebalance::app
