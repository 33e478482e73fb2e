#pragma once
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/stability/curve_stability.hpp"

namespace wavebalance::app {

/// The curve of a scene, in frequencies of a problem of analysis.subharmonic periods of the load.
solvers::FrequencySweepOptions sweep_options(const Scene& scene);

/// Multiplies every frequency of a curve, of its stability.
void scale_frequencies(solvers::FrequencySweep& curve, double factor);
void scale_frequencies(solvers::CurveStability& stability, double factor);

/// `observer`, to be called with frequencies of a problem of so many periods of the load.
solvers::Observer of_load(const solvers::Observer& observer, int periods);

}  // namespace wavebalance::app
