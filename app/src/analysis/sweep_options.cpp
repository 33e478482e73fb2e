#include "analysis/analysis_parts.hpp"

namespace wavebalance::app {

solvers::FrequencySweepOptions sweep_options(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  solvers::FrequencySweepOptions options;
  const bool over_amplitude = analysis.type == AnalysisType::amplitude_sweep;
  options.from = over_amplitude ? analysis.amplitude_from : analysis.frequency_from;
  options.to = over_amplitude ? analysis.amplitude_to : analysis.frequency_to;
  options.output_points = analysis.output_points;
  options.max_points = analysis.max_points;
  options.start.form = scene.contact.form;
  auto& arc = options.arc_length;
  arc.parameter_scale = std::abs(options.to - options.from) / 20.0;
  arc.initial_step = analysis.first_step / arc.parameter_scale;
  arc.max_step = analysis.largest_step / arc.parameter_scale;
  arc.min_step = std::min(arc.min_step, arc.initial_step / 20.0);
  return options;
}

solvers::ExactCurveOptions exact_options(const Scene& scene, const solvers::Observer& observer) {
  const solvers::FrequencySweepOptions balance = sweep_options(scene);
  solvers::ExactCurveOptions options;
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
