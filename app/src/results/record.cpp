#include "wavebalance/app/results/record.hpp"

#include <algorithm>
#include <chrono>

#include "results/damped_mode_record.hpp"
#include "results/diagram_record.hpp"
#include "results/limit_cycle_record.hpp"
#include "results/mode_record.hpp"
#include "results/motions_record.hpp"
#include "results/recorded_record.hpp"
#include "results/response_record.hpp"
#include "results/summary_parts.hpp"
#include "results/sweep_record.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/elastic_modes.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

Sweep stable_sweep(const Scene& scene, const StructureModel& model, const Observer& observer,
                   const StartMotion& start) {
  const bool over_amplitude = scene.analysis.type == AnalysisType::amplitude_sweep;
  if (scene.analysis.exact || solves_by_impacts(scene)) {
    Sweep sweep = exact_sweep(scene, model, observer, start);
    if (scene.analysis.exact) add_isolas(scene, model, sweep, observer);
    return sweep;
  }
  Sweep sweep = over_amplitude ? amplitude_sweep(scene, model, observer, start)
                               : frequency_sweep(scene, model, observer, start);
  if (!sweep.interrupted()) add_stability(scene, model, sweep, observer);
  add_phases(scene, model, sweep, observer);
  add_isolas(scene, model, sweep, observer);
  return sweep;
}

Record stable_sweep_record(const Scene& scene, const StructureModel& model, const StartMotion& start,
                           const Observer& observer) {
  Sweep sweep = stable_sweep(scene, model, observer, start);
  leave_out_contact_fractions(scene, sweep);
  const SweepOutputs outputs = measure_outputs(scene, model, sweep, observer);
  const auto motions = curve_motions(scene, model, sweep, observer);
  Record record = sweep_record(scene, model, sweep, outputs, motions);
  const bool found = !sweep.curve.points.empty();
  append_start(record, start, found, sweep.start_distance);
  if (!start.contacts.empty() && found)
    warn(record,
         "The curve was followed from its start towards the end of the interval alone: what lies the other "
         "way of the start was not sought.");
  return record;
}

Record forced_record(const Scene& scene, const StructureModel& model, const StartMotion& start,
                     ResponseOptions options) {
  const bool shooting = scene.analysis.type == AnalysisType::shooting;
  options.stability = scene.analysis.stability || shooting;
  options.phases = scene.analysis.phases;
  if (solves_by_impacts(scene)) return response_record(scene, model, impacts_response(scene, model, options));
  if (solves_by_phases(scene) || shooting)
    return response_record(scene, model, phases_response(scene, model, options));
  if (!start.contacts.empty()) {
    StartSamples samples = start_samples(start, scene);
    options.guess = std::move(samples.displacement);
    options.guess_force = std::move(samples.force);
    options.stay_near_guess = true;
  }
  const Response response = weighted_residual_response(scene, model, options);
  Record record = response_record(scene, model, response);
  append_start(record, start, response.converged, response.start_distance);
  return record;
}

Record stepping_record(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  Response response = integrates_by_events(scene) ? flow_response(scene, model, options)
                                                  : time_stepping_response(scene, model, options);
  const auto recorded = recorded_motion(scene, model, response, options.observer);
  response.recorded = recorded.has_value();
  Record record = response_record(scene, model, response);
  if (recorded) append_recorded(record, *recorded, response.contact);
  return record;
}

Record record_of(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  ResponseOptions options;
  options.observer = how.observer;
  options.structure_points = structure_points(scene);
  switch (scene.analysis.type) {
    case AnalysisType::frequency_sweep:
    case AnalysisType::amplitude_sweep:
      return stable_sweep_record(scene, model, how.start, how.observer);
    case AnalysisType::nonlinear_mode:
      if (is_damped_mode(scene)) return damped_mode_record(scene, model, how.observer);
      return mode_record(scene, model, how.observer);
    case AnalysisType::time_stepping:
      return stepping_record(scene, model, options);
    case AnalysisType::bifurcation_diagram:
      return diagram_record(scene, model, how.observer);
    case AnalysisType::motions:
      return motions_record(scene, model, how.observer);
    case AnalysisType::limit_cycle:
      return limit_cycle_record(scene, model, std::move(options));
    case AnalysisType::forced_response:
    case AnalysisType::shooting:
      break;
  }
  return forced_record(scene, model, how.start, std::move(options));
}

Record composed_record(const Scene& scene, const AnalysisOptions& how) {
  if (scene.structure.kept_modes >= 0) goes_on(how.observer, {"reduction of the structure"});
  StructureModel model = make_model(scene, how.observer);
  model.threads = how.threads;
  return record_of(scene, model, how);
}

}  // namespace

Record analyse(const Scene& scene, const Observer& observer) {
  return analyse(scene, AnalysisOptions{.observer = observer});
}

Record analyse(const Scene& scene, const AnalysisOptions& how) {
  const auto start = std::chrono::steady_clock::now();
  require_start_fits(how.start, scene);
  Record record = how.model != nullptr ? record_of(scene, *how.model, how) : composed_record(scene, how);
  set_warnings(record);
  insert_wall_seconds(record.summary,
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return record;
}

}  // namespace wavebalance::app
