#include "analysis/sweep_options.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::app {

double sweep_unit(const Scene& scene) {
  if (scene.analysis.type == AnalysisType::amplitude_sweep)
    return std::abs(reference_load(scene.forcing).value().amplitude);
  return scene.analysis.subharmonic;
}

solvers::FrequencySweepOptions sweep_options(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  solvers::FrequencySweepOptions options;
  const double one = sweep_unit(scene);
  const bool over_amplitude = analysis.type == AnalysisType::amplitude_sweep;
  options.from = (over_amplitude ? analysis.amplitude_from : analysis.frequency_from) / one;
  options.to = (over_amplitude ? analysis.amplitude_to : analysis.frequency_to) / one;
  options.output_points = analysis.output_points;
  options.max_points = analysis.max_points;
  options.start.form = scene.contact.form;
  auto& arc = options.arc_length;
  arc.parameter_scale = std::abs(options.to - options.from) / 20.0;
  arc.initial_step = analysis.first_step / one / arc.parameter_scale;
  arc.max_step = analysis.largest_step / one / arc.parameter_scale;
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

void scale_loads(solvers::FrequencySweep& curve, double factor) {
  for (auto& point : curve.points) point.load_scale *= factor;
  for (auto& turn : curve.turning_points) turn.load_scale *= factor;
}

void scale_loads(solvers::CurveStability& stability, double factor) {
  for (auto& point : stability.special_points) {
    point.load_scale *= factor;
    point.unknown_parameter *= factor;
    point.bracket *= factor;
  }
}

solvers::Observer of_amplitude(const solvers::Observer& observer, double factor, std::string_view unit) {
  if (!observer) return observer;
  return [observer, factor, unit](solvers::Progress progress) {
    if (progress.measure == "of the load") {
      progress.value *= factor;
      progress.measure = unit;
    }
    return observer(progress);
  };
}

solvers::Observer of_load(const solvers::Observer& observer, int periods) {
  if (!observer || periods == 1) return observer;
  return [observer, periods](solvers::Progress progress) {
    if (progress.measure == "Hz") progress.value *= periods;
    return observer(progress);
  };
}

}  // namespace wavebalance::app
