#include "results/record_parts.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/analysis_parts.hpp"
#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/results/record.hpp"
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
  summary.emplace_back("ladder", level_table(refinement));
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

/// The response's motion of the structure at the instants that the scene writes.
Eigen::MatrixXd written_motion(const Scene& scene, const Response& response) {
  const Eigen::MatrixXd& all = response.structure.displacement;
  const Eigen::Index points = scene.analysis.motion_points;
  if (all.cols() <= points) return all;
  return all(Eigen::all, Eigen::seqN(0, points, all.cols() / points));
}

void append_rigid(Summary& summary, const Response& response) {
  if (!response.rigid) return;
  const RigidContact& rigid = *response.rigid;
  const bool moves = response.moves;
  summary.emplace_back(quantities::max_penetration, moves ? std::max(0.0, rigid.max_penetration) : missing);
  summary.emplace_back(quantities::min_contact_force, moves ? rigid.min_force : missing);
  summary.emplace_back(quantities::complementarity, moves ? rigid.product : missing);
}

/// ", which analysis.subharmonic = 2 computes", if the scene supports it.
std::string computed_by(const Scene& scene, int periods) {
  SceneChange change = as_response(scene);
  change.set.push_back(fmt::format("analysis.subharmonic={}", periods));
  if (!accepts(scene, change)) return "";
  return fmt::format(
      "; {}analysis.subharmonic = {} computes it",
      scene.analysis.type == AnalysisType::forced_response ? "" : "analysis.type = \"forced_response\" with ",
      periods);
}

void append_attractor(Record& record, const Scene& scene, const Response& response) {
  if (response.attractor_periods < 0) return;
  record.add("attractor_periods", response.attractor_periods);
  const int attractor = response.attractor_periods;
  if (response.recorded) return;
  const char* start = response.flow ? "From contacts at rest" : "From rest";
  if (attractor > 0 && response.periods % attractor == 0) {
    if (!response.moves)
      record.warnings.push_back(
          "Time integration from rest converges to a motion of this period, but the discretised "
          "equations were not solved near it. More time.functions or time.method = \"exact\" may "
          "help.");
    return;
  }
  record.warnings.push_back(
      attractor == 0
          ? fmt::format(
                "{} the motion did not repeat after up to 16 forcing periods within the integrated time: "
                "it is aperiodic or still transient.",
                start)
          : fmt::format("{} time integration converges to a motion of {} forcing periods{}.", start,
                        attractor, computed_by(scene, attractor)));
}

void append_attractor_from_rest(Record& record, const Scene& scene, const Response& response) {
  if (!response.settled) return;
  const AttractorFromRest& beside = *response.settled;
  record.add(quantities::settled_periods, beside.periods);
  record.add(quantities::settled_max_displacement, beside.periods > 0 ? beside.max_displacement : missing);
  const std::string others =
      std::string(" Other motions were not searched for") +
      (accepts(scene, {.analysis = "motions"}) ? "; analysis.type = \"motions\" does so." : ".");
  constexpr double rounding = 1e-9;  // an obstacle at zero holds the displacement there
  const double size =
      response.contacts.empty() ? 0.0 : rounding * response.contacts.displacement.cwiseAbs().maxCoeff();
  if (beside.periods > 0)
    warn(record,
         "From rest time integration converges to {} motion, of {} and with a largest "
         "displacement of {}{}.{}",
         response.moves ? "another" : "a",
         beside.periods == 1 ? "one period" : fmt::format("{} periods", beside.periods),
         quantity(std::abs(beside.max_displacement) <= size ? 0.0 : beside.max_displacement,
                  displacement_unit(scene)),
         response.moves ? "" : " (no exact solution was found for it)", others);
  else
    record.warnings.push_back(
        (beside.periods == 0
             ? "From rest the motion did not repeat after up to 16 forcing periods within the integrated time."
             : "The attractor reached from rest is not known.") +
        others);
}

/// Names the analysis of the motion that occurs if time integration from rest found none.
void warn_of_another_motion(Record& record, const Scene& scene, const Response& response) {
  const bool unstable = response.stability && response.stability->unstable > 0 && !response.flow;
  if (!unstable || (response.settled && response.settled->periods > 0)) return;
  if (accepts(scene, statistics_in_time()))
    record.warnings.emplace_back(
        "analysis.type = \"time_stepping\" with analysis.max_periods = 200 computes the motion that occurs "
        "instead, with statistics if it is aperiodic.");
}

void append_other_motions(Record& record, const Scene& scene, const Response& response) {
  if (!response.moves || scene.contact.law == no_law || !kind_of(scene.analysis.type).under_load) return;
  const bool integrated = integrates_in_time(scene.analysis.type) && !is_exact(response);
  const bool from_rest = response.settled || (response.attractor_periods >= 0 && !integrated);
  record.add(quantities::other_motions, from_rest ? "settled_from_rest" : "not_sought");
}

void append_dissipation(Summary& summary, const Scene& scene, const Response& response) {
  if (!has_damped_contact(scene)) return;
  const solvers::Motion& motion = response.contacts;
  const solvers::ContactLaws laws = make_laws(scene);
  double power = !response.moves || motion.empty() ? missing : 0.0;
  for (int row = 0; row < motion.rows(); row += laws[row].rows())
    if (!laws[row].friction()) power += motion.force.row(row).dot(motion.velocity.row(row)) / motion.points();
  summary.emplace_back(quantities::contact_dissipation, power / scene.forcing.frequency);
}

/// The relative error of the vibration of the contact with the largest force, not below the error of the
/// exact motion; missing without a motion.
double vibration_error(const solvers::ExactSolution& motion, const Response& response) {
  if (motion.parts == nullptr) return missing;
  const Eigen::MatrixXd exact = motion.displacement(time_fractions(response.contacts.points()));
  const double vibration = solvers::largest_vibration(exact.row(response.contact)).half_peak_to_peak;
  const double measured = solvers::largest_vibration(response.leading().displacement).half_peak_to_peak;
  return std::max(motion.estimated_error, std::abs(measured - vibration) / vibration);
}

void append_exact(Record& record, const Scene& scene, const Response& response) {
  const solvers::ExactNearResponse& found = *response.exact;
  const bool known = found.motion.parts != nullptr;
  if (is_exact(response)) {
    record.add(quantities::tolerance, exact_tolerance(scene));
    record.add(quantities::estimated_error, known ? found.motion.estimated_error : missing);
    record.add("start_functions", response.start_functions);
    if (!response.form.empty())
      record.warnings.push_back(fmt::format(
          "The functions of the scene do not hold this motion: no solution of the discretised equations was "
          "found near it. It is the exact motion {}.",
          response.strategy == to_string(solvers::Strategy::recurrence)
              ? "to which the motion from rest nearly returns"
              : "that time integration from rest converges to"));
  } else {
    record.add(quantities::phases_status, to_string(found.motion.status));
    record.add(quantities::error_of_vibration, vibration_error(found.motion, response));
    record.add(quantities::error_of_displacement, found.displacement_error);
    record.add(quantities::error_of_force, found.force_error);
  }
  record.add("phases_estimated_error", known ? found.motion.estimated_error : missing);
  record.add("phases_unknowns", found.motion.unknowns);
  record.add(quantities::contact_intervals, intervals_table(scene, found.motion));
  if (response.stability && found.motion.status == solvers::ExactStatus::too_many_intervals)
    record.warnings.emplace_back(
        "The exact periodic solution near this response takes too long. analysis.phases = false counts the "
        "multipliers of the response itself.");
  const bool none = found.motion.status == solvers::ExactStatus::not_found && !is_exact(response);
  if (response.stability && !none)
    record.add(quantities::stability_by, response.stability->is_exact ? "phases" : "balance");
  if (!none) return;
  record.warnings.emplace_back(
      "No exact periodic solution was found near this response, which satisfies the contact "
      "law at its time samples only. Whether one exists is not known. More functions may lead "
      "to it.");
}

int structure_points(const Scene& scene) {
  const int written = std::max(0, scene.analysis.motion_points);
  if (!scene.analysis.outputs.empty() || has_unbalance_orbit(scene) || (has_friction(scene) && written == 0))
    return scene.analysis.output_points;
  if (written > 0 || scene.structure.type != StructureType::bar) return written;
  return integrates_in_time(scene.analysis.type) ? scene.analysis.output_points : bar_instants;
}

}  // namespace

ResponseOptions response_options(const Scene& scene, const Observer& observer) {
  ResponseOptions options;
  options.observer = observer;
  options.structure_points = structure_points(scene);
  return options;
}

Record response_record(const Scene& scene, const StructureModel& model, const Response& response) {
  Record record;
  record.warnings = model.warnings;
  record.converged = response.converged;
  record.status = response.status;
  warn_of_unbalanced_load(record, model);
  begin_summary(record, response.residual, response.iterations, response.unknowns, response.wall_seconds);
  append_motion(record.summary, scene, response.moves ? response.contacts : solvers::Motion{},
                response.contact);
  append_dissipation(record.summary, scene, response);
  append_friction(record, scene, response, scene.forcing.frequency);
  append_equivalent_damping(record, scene, model, response);
  append_impacts(record, scene, response);
  record.add(quantities::analysis, name_of(scene.analysis.type));
  record.add(quantities::frequency, scene.forcing.frequency);
  if ((scene.analysis.type == AnalysisType::forced_response || is_exact(response)) && !response.impacts)
    record.add("strategy", response.strategy);
  if (!response.solved_by.empty()) record.add(quantities::solved_by, response.solved_by);
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
    record.add(quantities::change_after_one_period, response.moves ? response.change_after_one : missing);
  append_attractor(record, scene, response);
  if (!response.form.empty()) record.add(quantities::form, response.form);
  append_rigid(record.summary, response);
  if (response.exact)
    append_exact(record, scene, response);
  else if (scene.analysis.exact_near && response.converged && !is_exact(response))
    record.add(quantities::phases_status, "no_modes");
  if (response.stability) append_stability(record, *response.stability);
  append_attractor_from_rest(record, scene, response);
  warn_of_another_motion(record, scene, response);
  append_other_motions(record, scene, response);
  append_condition(record, response.condition, response.rounding_error);
  if (response.refinement) append_refinement(record.summary, *response.refinement, scene.time.tolerance);
  if (response.structure_harmonics > 0) record.add("structure_left_out", response.structure_left_out);
  if (scene.analysis.type == AnalysisType::forced_response && !is_exact(response) && !response.impacts)
    append_discretisation(record.summary, solved_time(scene.time, response));
  append_structure(record.summary, scene, model);
  append_rest(record, scene, model);
  append_outputs(record, scene, model, response, {scene.forcing.frequency, 1.0, response.periods});
  if (!response.moves || response.contacts.empty()) return record;
  record.response = response_table(response.leading());
  record.figure = response_figure(scene, response);
  lead_with_output(record, scene);
  append_orbits(record, scene, model, response);
  add_contacts(record, scene, response.contacts, response.contact);
  record.bar_motion = bar_motion_of(scene, model, response);
  if (scene.analysis.motion_points > 0)
    for (RecordFile& file : motion_files(model, written_motion(scene, response)))
      record.files.push_back(std::move(file));
  return record;
}

}  // namespace wavebalance::app
