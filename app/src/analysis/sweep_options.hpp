#pragma once
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::app {

/// How the curve of a scene is followed, in frequencies or amplitudes of the load.
solvers::FrequencySweepOptions sweep_options(const Scene& scene);

}  // namespace wavebalance::app
