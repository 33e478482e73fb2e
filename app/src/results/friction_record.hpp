#pragma once
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// What contacts with friction do: their work, shares of the period, slip and wear in the summary, and
/// friction.csv with the loops of force and displacement and the state at every instant.
void append_friction(Record& record, const Scene& scene, const Response& response);

}  // namespace wavebalance::app
