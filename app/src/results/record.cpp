#include "wavebalance/app/results/record.hpp"

#include <algorithm>
#include <limits>

#include "files/number_text.hpp"
#include "results/analyses.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
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
  add_exact(scene, model, sweep, observer);
  add_isolas(scene, model, sweep, observer);
  return sweep;
}

}  // namespace

Record curve_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  const StartMotion& start = how.start;
  const Observer& observer = how.observer;
  Sweep sweep = stable_sweep(scene, model, observer, start);
  leave_out_contact_fractions(scene, sweep);
  const SweepOutputs outputs = measure_outputs(scene, model, sweep, observer);
  const auto motions = curve_motions(scene, model, sweep, observer);
  Record record = sweep_record(scene, model, sweep, outputs, motions);
  const bool found = !sweep.curve.points.empty();
  append_start(record, start, found, sweep.start_distance);
  if (!start.contacts.empty() && found)
    warn(record,
         "The curve was followed from its start to the end of the interval only. The part on the "
         "other side of the start was not searched for.");
  return record;
}

namespace {

Response solved_response(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  ResponseOptions options = response_options(scene, how.observer);
  options.stability = scene.analysis.stability;
  options.exact = scene.analysis.exact_near;
  options.exact_instead = scene.analysis.exact_near;
  if (solves_by_impacts(scene)) return impacts_response(scene, model, options);
  if (solves_exactly(scene)) return exact_response(scene, model, options);
  if (!how.start.contacts.empty()) {
    StartSamples samples = start_samples(how.start, scene);
    options.guess = std::move(samples.displacement);
    options.guess_force = std::move(samples.force);
    options.stay_near_guess = true;
  }
  return weighted_residual_response(scene, model, options);
}

bool found_no_period(const Response& response) {
  return !response.converged &&
         (response.attractor_periods == 0 || (response.settled && response.settled->periods == 0) ||
          response.status == to_string(solvers::ExactStatus::not_settled));
}

/// Periods that can be recorded after `found` within so many operations.
int affordable_periods(const Response& found, double max_operations) {
  const double left = max_operations / found.flow->operations - 1.0;
  return int(std::min(left * found.iterations, double(std::numeric_limits<int>::max())));
}

Record record_in_time(Scene scene, const StructureModel& model, const AnalysisOptions& how,
                      double max_operations) {
  ResponseOptions options = response_options(scene, how.observer);
  // Leaves operations for the least record.
  const double waited = scene.analysis.max_periods;
  options.max_operations = max_operations * waited / (waited + least_recorded_periods);
  Response response = flow_response(scene, model, options);
  const int affordable = response.moves ? affordable_periods(response, max_operations) : 0;
  scene.analysis.recorded_periods = std::min(scene.analysis.recorded_periods, affordable);
  std::optional<RecordedMotion> recorded;
  if (affordable >= least_recorded_periods)
    recorded = recorded_motion(scene, model, response, options.observer);
  response.recorded = recorded.has_value();
  // The motion of the structure requires periodic forces; the statistics have the outputs.
  if (recorded) response.structure = {};
  Record record = response_record(scene, model, response);
  if (recorded) append_recorded(record, *recorded, scene, response.contact);
  if (recorded && affordable == scene.analysis.recorded_periods)
    warn(record,
         "The record was ended after {} periods, which take some seconds. analysis.type = \"time_stepping\" "
         "records all.",
         affordable);
  return record;
}

/// The motion in time instead of a response that was not found, if it is aperiodic and some seconds suffice.
std::optional<Record> aperiodic_record(const Scene& scene, const StructureModel& model,
                                       const AnalysisOptions& how) {
  constexpr double most_operations = 1e10;
  const auto in_time = changed_scene(scene, statistics_in_time());
  if (!in_time || scene.analysis.recorded_periods == 0) return std::nullopt;
  Record record = record_in_time(*in_time, model, how, most_operations);
  if (record.status != quantities::aperiodic) return std::nullopt;
  for (Entry& entry : record.summary)
    if (entry.name == quantities::analysis.name) entry.value = name_of(scene.analysis.type);
  record.add(quantities::solved_by, name_of(in_time->analysis.type));
  return record;
}

}  // namespace

Record forced_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  const Response response = solved_response(scene, model, how);
  if (how.start.contacts.empty() && found_no_period(response))
    if (auto aperiodic = aperiodic_record(scene, model, how)) return *std::move(aperiodic);
  Record record = response_record(scene, model, response);
  append_start(record, how.start, response.converged, response.start_distance);
  return record;
}

std::string stepping_plan(const Scene& scene) {
  const std::string advice = slow_stepping_advice(scene);
  return fmt::format("size       {} states, periods until they differ by {}\n{}", 2 * reduced_size(scene),
                     number_text(scene.analysis.tolerance),
                     advice.empty() ? "" : "advice     " + advice + "\n");
}

Record stepping_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  return record_in_time(scene, model, how, std::numeric_limits<double>::infinity());
}

const AnalysisPart& part_of(AnalysisType type) {
  return *std::ranges::find_if(analysis_parts,
                               [type](const AnalysisPart& part) { return part.type == type; });
}

namespace {

Record composed_record(const Scene& scene, const AnalysisOptions& how) {
  if (scene.structure.kept_modes >= 0) goes_on(how.observer, {"reduction of the structure"});
  StructureModel model = make_model(scene, how.observer);
  model.threads = how.threads;
  return part_of(scene.analysis.type).record(scene, model, how);
}

}  // namespace

Record analyse(const Scene& scene, const Observer& observer) {
  return analyse(scene, AnalysisOptions{.observer = observer});
}

Record analyse(const Scene& scene, const AnalysisOptions& how) {
  const WallClock clock;
  require_start_fits(how.start, scene);
  Record record = how.model != nullptr ? part_of(scene.analysis.type).record(scene, *how.model, how)
                                       : composed_record(scene, how);
  set_warnings(record);
  insert_wall_seconds(record.summary, clock.seconds());
  return record;
}

}  // namespace wavebalance::app
