#include "analysis/sweep_options.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::app {

solvers::FrequencySweepOptions sweep_options(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  solvers::FrequencySweepOptions options;
  const int periods = analysis.subharmonic;
  options.from = analysis.frequency_from / periods;
  options.to = analysis.frequency_to / periods;
  options.output_points = analysis.output_points;
  options.max_points = analysis.max_points;
  options.start.form = scene.contact.form;
  auto& arc = options.arc_length;
  arc.parameter_scale = std::abs(options.to - options.from) / 20.0;
  arc.initial_step = analysis.first_step / periods / arc.parameter_scale;
  arc.max_step = analysis.largest_step / periods / arc.parameter_scale;
  arc.min_step = std::min(arc.min_step, arc.initial_step / 20.0);
  return options;
}

void scale_frequencies(solvers::FrequencySweep& curve, double factor) {
  for (auto& point : curve.points) point.frequency *= factor;
  for (auto& turn : curve.turning_points) turn.frequency *= factor;
}

void scale_frequencies(solvers::CurveStability& stability, double factor) {
  for (auto& point : stability.special_points) {
    point.frequency *= factor;
    point.unknown_parameter *= factor;
    point.bracket *= factor;
  }
}

solvers::Observer of_load(const solvers::Observer& observer, int periods) {
  if (!observer || periods == 1) return observer;
  return [observer, periods](solvers::Progress progress) {
    if (progress.measure == "Hz") progress.value *= periods;
    return observer(progress);
  };
}

}  // namespace wavebalance::app
