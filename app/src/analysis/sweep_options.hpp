#pragma once
#include <algorithm>

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::app {

/// How the curve of a scene is followed, in frequencies or amplitudes of the load.
solvers::FrequencySweepOptions sweep_options(const Scene& scene);

/// The same for a curve whose motions are exact: of solvers::ExactCurveOptions or ImpactCurveOptions.
template <class Options>
Options exact_options(const Scene& scene, const solvers::Observer& observer) {
  const solvers::FrequencySweepOptions balance = sweep_options(scene);
  Options options;
  options.from = balance.from;
  options.to = balance.to;
  options.max_points = balance.max_points;
  options.first_step = std::min(options.first_step, balance.arc_length.initial_step);
  options.largest_step = balance.arc_length.max_step;
  options.stability = scene.analysis.stability;
  options.observer = observer;
  return options;
}

}  // namespace wavebalance::app
