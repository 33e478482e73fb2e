#pragma once
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::app {

/// How the curve of a scene is followed, in frequencies or amplitudes of the load.
solvers::FrequencySweepOptions sweep_options(const Scene& scene);

/// The same for a curve whose motions are exact.
solvers::ExactCurveOptions exact_options(const Scene& scene, const solvers::Observer& observer);

}  // namespace wavebalance::app
