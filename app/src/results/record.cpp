#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/compose/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "analysis/response_parts.hpp"
#include "analysis/sweep_axis.hpp"
#include "drawing/record_figure.hpp"
#include "files/missing.hpp"
#include "results/curve_motion_files.hpp"
#include "results/damped_mode_record.hpp"
#include "results/friction_record.hpp"
#include "results/impacts_record.hpp"
#include "results/mode_record.hpp"
#include "results/motion_files.hpp"
#include "results/motions_record.hpp"
#include "results/output_record.hpp"
#include "results/quantities.hpp"
#include "results/rest_record.hpp"
#include "results/stability.hpp"
#include "results/summary_parts.hpp"
#include "results/sweep_phases.hpp"
#include "results/vibration_record.hpp"
#include "wavebalance/app/analysis/curve_motions.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/elastic_modes.hpp"
#include "wavebalance/app/results/tables.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

Table level_table(const Refinement& refinement) {
  Table table({"trial", "weight", "functions", "quadrature_points", "estimated_error", "truncation_error",
               "quadrature_error", "residual", "iterations", "seconds"});
  for (const auto& level : refinement.levels)
    table.append_row({refinement.trial, refinement.weight, std::int64_t{level.functions},
                      std::int64_t{level.points}, level.estimated_error, level.truncation, level.quadrature,
                      level.residual, std::int64_t{level.iterations}, level.seconds});
  return table;
}

void append_refinement(Summary& summary, const Refinement& refinement, double tolerance) {
  summary.emplace_back(quantities::tolerance, tolerance);
  summary.emplace_back(quantities::estimated_error, refinement.estimated_error);
  summary.emplace_back(quantities::ladder, level_table(refinement));
  summary.emplace_back(quantities::ladder_seconds, refinement.seconds);
}

/// Instants of the period at which the motion of a bar is kept for its report.
constexpr int bar_instants = 128;

/// The response's motion of the structure at bar_instants or, where that does not divide it, at all instants.
Eigen::MatrixXd bar_motion_of(const Scene& scene, const StructureModel& model, const Response& response) {
  const Eigen::MatrixXd& reduced = response.structure.displacement;
  if (scene.structure.type != StructureType::bar || reduced.cols() == 0) return {};
  const Eigen::MatrixXd nodes = model.recover(reduced);
  const Eigen::Index step = nodes.cols() % bar_instants == 0 ? nodes.cols() / bar_instants : 1;
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(nodes.rows() + 1, nodes.cols() / step);
  for (Eigen::Index k = 0; k < motion.cols(); ++k) motion.col(k).tail(nodes.rows()) = nodes.col(k * step);
  return motion;
}

/// The instants at which the motion of the whole structure is computed: those that the scene writes, those of
/// its outputs or its energy beside friction, or those of a bar's report.
int structure_points(const Scene& scene) {
  const int written = std::max(0, scene.analysis.motion_points);
  if (!scene.analysis.outputs.empty() || (has_friction(scene) && written == 0))
    return scene.analysis.output_points;
  if (written > 0 || scene.structure.type != StructureType::bar) return written;
  return integrates_in_time(scene.analysis.type) ? scene.analysis.output_points : bar_instants;
}

/// The response's motion of the structure at the instants that the scene writes.
Eigen::MatrixXd written_motion(const Scene& scene, const Response& response) {
  const Eigen::MatrixXd& all = response.structure.displacement;
  const Eigen::Index points = scene.analysis.motion_points;
  if (all.cols() <= points) return all;
  return all(Eigen::all, Eigen::seqN(0, points, all.cols() / points));
}

/// Why a structure that is free to move has no periodic motion, and along what it moves. A response that was
/// not found for another reason says nothing of its load.
void warn_of_unbalanced_load(Record& record, const StructureModel& model) {
  const Eigen::MatrixXd& rigid = model.structure.rigid_modes;
  if (rigid.cols() == 0 || record.status != "unbalanced") return;
  const Eigen::MatrixXd moved = model.reduced() ? Eigen::MatrixXd(model.recovery * rigid) : rigid;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    Eigen::Index row = 0;
    moved.col(i).cwiseAbs().maxCoeff(&row);
    if (std::find(rows.begin(), rows.end(), row + 1) == rows.end()) rows.push_back(row + 1);
  }
  record.warnings.push_back(fmt::format(
      "The structure is free to move along {} rigid motion{}, which move degree{} of freedom {} most. Since no contact "
      "force balances its static load, no periodic motion exists.",
      rigid.cols(), rigid.cols() == 1 ? "" : "s", rows.size() == 1 ? "" : "s", fmt::join(rows, ", ")));
}

void append_rigid(Summary& summary, const Response& response) {
  if (!response.rigid) return;
  const RigidContact& rigid = *response.rigid;
  const bool moves = response.moves;
  summary.emplace_back(quantities::max_penetration, moves ? std::max(0.0, rigid.max_penetration) : missing);
  summary.emplace_back(quantities::min_contact_force, moves ? rigid.min_force : missing);
  summary.emplace_back(quantities::complementarity, moves ? rigid.product : missing);
}

Record response_record(const Scene& scene, const StructureModel& model, const Response& response) {
  Record record;
  record.warnings = model.warnings;
  record.converged = response.converged;
  record.status = response.status;
  warn_of_unbalanced_load(record, model);
  record.summary = solution_entries(response.converged, response.status, response.residual,
                                    response.iterations, response.unknowns, response.wall_seconds);
  append_motion(record.summary, scene, response.moves ? response.contacts : solvers::Motion{},
                response.contact);
  append_dissipation(record.summary, scene, response);
  append_friction(record, scene, response, scene.forcing.frequency);
  append_equivalent_damping(record, scene, model, response);
  append_impacts(record, scene, response);
  record.summary.emplace_back(quantities::analysis, name_of(scene.analysis.type));
  record.summary.emplace_back(quantities::frequency, scene.forcing.frequency);
  if ((scene.analysis.type == AnalysisType::forced_response || is_by_phases(response)) && !response.impacts)
    record.summary.emplace_back(quantities::strategy, response.strategy);
  if (!response.solved_by.empty()) record.summary.emplace_back(quantities::solved_by, response.solved_by);
  warn_of_scene(record, scene);
  const bool touches =
      !response.struck.empty() || (response.forces_are_known() && response.contacts.force.any());
  if (response.moves && scene.contact.law != no_law && !touches) {
    const bool ring = names_plane(scene.contact);  // which is reached along any radius
    const double gap = ring ? missing : model.gaps[response.contact];
    warn_of_open_contacts(record, gap - response.leading().displacement.maxCoeff(), gap,
                          displacement_unit(scene));
  }
  if (!response.impacts) append_period(record, response.periods, response.motion_periods);
  if (response.periods > 1 && !response.impacts)
    record.summary.emplace_back(quantities::change_after_one_period,
                                response.moves ? response.change_after_one : missing);
  append_attractor(record, scene, response);
  if (!response.form.empty()) record.summary.emplace_back(quantities::form, response.form);
  append_rigid(record.summary, response);
  if (response.phases)
    append_phases(record, scene, response);
  else if (scene.analysis.phases && response.converged && !is_by_phases(response))
    record.summary.emplace_back(quantities::phases_status, "no_modes");
  if (response.stability) append_stability(record, *response.stability);
  append_settled(record, scene, response);
  append_other_motions(record, scene, response);
  append_condition(record, response.condition, response.rounding_error);
  if (response.refinement) append_refinement(record.summary, *response.refinement, scene.time.tolerance);
  if (response.structure_harmonics > 0)
    record.summary.emplace_back(quantities::structure_left_out, response.structure_left_out);
  if (scene.analysis.type == AnalysisType::forced_response && !is_by_phases(response) && !response.impacts)
    append_discretisation(record.summary, solved_time(scene.time, response));
  append_structure(record.summary, scene, model);
  append_rest(record, scene, model);
  append_outputs(record, scene, model, response);
  if (!response.moves || response.contacts.empty()) return record;
  record.response = response_table(response.leading());
  record.figure = response_figure(scene, response);
  lead_with_output(record, scene);
  add_contacts(record, scene, response.contacts, response.contact);
  record.bar_motion = bar_motion_of(scene, model, response);
  if (scene.analysis.motion_points > 0)
    for (RecordFile& file : motion_files(model, written_motion(scene, response)))
      record.files.push_back(std::move(file));
  return record;
}

double largest(const solvers::FrequencySweep& curve, double solvers::SweepPoint::*member) {
  double value = missing;
  for (const auto& point : curve.points) value = std::fmax(value, point.*member);
  return value;
}

/// Missing without points.
double least_displacement(const solvers::FrequencySweep& curve) {
  double value = missing;
  for (const auto& point : curve.points) value = std::fmin(value, point.min_displacement);
  return value;
}

/// The largest contact force of a curve: that of the one law at the largest displacement, or of the samples
/// where contacts differ, and where the displacement alone does not say it.
double largest_force(const Scene& scene, const solvers::FrequencySweep& curve, double displacement) {
  if (curve.points.empty() || solves_by_impacts(scene)) return missing;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const bool one = std::all_of(contacts.begin(), contacts.end(), [&](const SceneContact& other) {
    return !other.pair && other.same_law(contacts.front());
  });
  const std::string& law = scene.contact.law;
  if (one && curve.form != solvers::ContactForm::force && !is_damped(law) && !acts_on_both_sides(law))
    return make_laws(scene)[0].force(displacement);
  return largest(curve, &solvers::SweepPoint::max_force);
}

/// Whether a contact closes anywhere along the curve.
bool touches(const Sweep& sweep) {
  if (sweep.impacts.empty()) return largest(sweep.curve, &solvers::SweepPoint::max_force) > 0.0;
  return std::any_of(sweep.impacts.front().begin(), sweep.impacts.front().end(),
                     [](const PointImpacts& point) { return point.count > 0; });
}

/// Of each point, the most where they differ.
int unknowns_of(const Scene& scene, const StructureModel& model, const Sweep& sweep) {
  if (sweep.impacts.empty()) return model.contacts() * scene.time.functions;
  int most = 0;
  for (const PointImpacts& point : sweep.impacts.front()) most = std::max(most, 2 * point.count + 1);
  return most;
}

/// Frequency or amplitude of the point with the largest displacement; missing without points.
double place_of_peak(const solvers::FrequencySweep& curve) {
  return curve.points.empty() ? missing
                              : solvers::parameter_of(curve.points[peak_of(curve)], curve.parameter);
}

Record sweep_record(const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const SweepOutputs& outputs, const std::vector<CurveMotion>& motions) {
  Record record;
  record.interrupted = sweep.stopped();
  record.converged = sweep.converged() && !record.interrupted;
  record.status = record.interrupted ? "interrupted" : sweep.status();
  record.warnings = model.warnings;
  warn_of_unbalanced_load(record, model);
  if (!sweep.start_status.empty() && !record.interrupted)
    record.warnings.push_back(
        fmt::format("Where the curve was to begin no periodic motion was found that a curve begins with: {}.",
                    sweep.start_status) +
        (sweep.start_status == "undetermined"
             ? " Nothing holds a body, whose motion may be anywhere; a soft spring to ground holds it."
             : ""));
  const double highest = largest(sweep.curve, &solvers::SweepPoint::max_displacement);
  const int points = static_cast<int>(sweep.curve.points.size());
  record.summary =
      solution_entries(record.converged, record.status, largest(sweep.curve, &solvers::SweepPoint::residual),
                       points, unknowns_of(scene, model, sweep), sweep.wall_seconds);
  record.summary.emplace_back(quantities::max_displacement, highest);
  record.axis = sweep_axis(sweep);
  record.summary.emplace_back(quantities::peak_place(record.axis.unit), place_of_peak(sweep.curve));
  record.summary.emplace_back(quantities::min_displacement, least_displacement(sweep.curve));
  record.summary.emplace_back(quantities::rms_displacement,
                              largest(sweep.curve, &solvers::SweepPoint::rms_displacement));
  append_vibration(record.summary, scene, sweep);
  append_friction_along(record.summary, sweep);
  record.summary.emplace_back(quantities::max_contact_force, largest_force(scene, sweep.curve, highest));
  record.summary.emplace_back(quantities::contact_fraction,
                              largest(sweep.curve, &solvers::SweepPoint::contact_fraction));
  record.summary.emplace_back(quantities::analysis, name_of(scene.analysis.type));
  if (scene.analysis.type == AnalysisType::amplitude_sweep)
    record.summary.emplace_back(quantities::frequency, scene.forcing.frequency);
  record.summary.emplace_back(quantities::points, std::int64_t{points});
  warn_of_scene(record, scene);
  if (points > 0 && scene.contact.law != no_law && !touches(sweep))
    warn_of_open_contacts(record, common_gap(scene) - highest, common_gap(scene), displacement_unit(scene));
  if (sweep.impacts.empty()) append_period(record, sweep.periods, sweep.motion_periods);
  append_impacts(record, sweep);
  append_stability(record, scene, sweep);
  append_phases(record, sweep);
  if (scene.analysis.branches) append_branches(record, sweep);
  append_isolas(record, scene, sweep);
  append_motions(record, scene, model, sweep, motions);
  if (!sweep.impacts.empty()) {
    record.summary.emplace_back(quantities::solved_by, "impacts");
  } else if (!sweep.exact_motions.empty() || scene.analysis.exact) {
    record.summary.emplace_back(quantities::solved_by, name_of(TimeMethod::exact));
  } else {
    append_discretisation(record.summary, scene.time);
    record.summary.emplace_back(quantities::form, std::string(to_string(sweep.curve.form)));
    append_condition(record, sweep.curve.condition, sweep.curve.rounding_error);
  }
  append_structure(record.summary, scene, model);
  append_rest(record, scene, model);
  record.sweep = sweep_table(sweep, scene.analysis.branches);
  append_outputs(record, scene, sweep, outputs);
  if (points > 0) record.figure = sweep_figure(scene, sweep, outputs);
  return record;
}

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
  append_start(record, start, !sweep.curve.points.empty(), sweep.start_distance);
  if (!start.contacts.empty() && !sweep.curve.points.empty())
    record.warnings.push_back(
        "The curve was followed from its start towards the end of the interval alone: what lies the other way of the "
        "start was not sought.");
  return record;
}

Record forced_record(const Scene& scene, const StructureModel& model, const StartMotion& start,
                     ResponseOptions options) {
  options.stability = scene.analysis.stability;
  options.phases = scene.analysis.phases;
  if (solves_by_impacts(scene)) return response_record(scene, model, impacts_response(scene, model, options));
  if (solves_by_phases(scene)) return response_record(scene, model, phases_response(scene, model, options));
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
      if (integrates_by_events(scene))
        return response_record(scene, model, flow_response(scene, model, options));
      return response_record(scene, model, time_stepping_response(scene, model, options));
    case AnalysisType::shooting:
      options.stability = true;
      return response_record(scene, model,
                             solves_by_impacts(scene) ? impacts_response(scene, model, options)
                                                      : phases_response(scene, model, options));
    case AnalysisType::motions:
      return motions_record(scene, model, how.observer);
    case AnalysisType::forced_response:
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
