#pragma once
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What contacts with friction do: their work, shares of the period, slip and wear in the summary, and
/// friction.csv with the loops of force and displacement and the state at every instant, and how far the
/// friction work is from the work of the load (frequency, Hz) less that of the damping.
void append_friction(Record& record, const Scene& scene, const Response& response, double frequency);

}  // namespace wavebalance::app
