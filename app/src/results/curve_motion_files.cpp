#include "results/curve_motion_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/sweep_axis.hpp"
#include "drawing/record_figure.hpp"
#include "files/missing.hpp"
#include "results/motion_files.hpp"
#include "results/quantities.hpp"
#include "results/summary_parts.hpp"
#include "results/sweep_phases.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::app {
namespace {

std::vector<Cell> row_of(const Scene& scene, const CurveMotion& motion, bool with_phases) {
  Summary values;
  append_motion(values, scene, motion.contacts, motion.contact);
  std::vector<Cell> row{motion.name + ".csv", motion.at, motion.place};
  for (const Entry& one : values) row.emplace_back(std::get<double>(one.value));
  row.emplace_back(motion.stability.unstable < 0 ? missing : double(motion.stability.unstable));
  row.emplace_back(motion.residual);
  row.emplace_back(motion.converged);
  if (with_phases)
    for (Cell& cell : phases_cells(motion.phases)) row.push_back(std::move(cell));
  return row;
}

std::string place_of(const CurveMotion& motion, const SweepAxis& axis) {
  if (motion.at == axis.quantity) return fmt::format("at {} {}", cell_text(motion.place), axis.unit);
  std::string type = motion.at;
  std::replace(type.begin(), type.end(), '_', ' ');
  return fmt::format("at the {}, {:.7g} {}", type, motion.place, axis.unit);
}

void append_files(Record& record, const Scene& scene, const StructureModel& model, const CurveMotion& motion,
                  const std::string& place) {
  const std::string about = "motion of the curve " + place;
  const bool several = motion.contacts.rows() > 1;
  record.files.push_back({motion.name + ".csv",
                          csv_text(response_table(motion.contacts.contact(motion.contact))),
                          about + (several ? ": the leading contact" : "")});
  if (several)
    record.files.push_back({motion.name + "_contacts.csv", csv_text(contacts_table(scene, motion.contacts)),
                            about + ": every contact"});
  for (RecordFile& file : motion_files(model, motion.structure, motion.name)) {
    file.about = about + ": the whole structure";
    record.files.push_back(std::move(file));
  }
}

/// The motion as that of a single response, with the instants of contact where these are known.
void append_motion_picture(Record& record, const Scene& scene, const Sweep& sweep, const CurveMotion& motion,
                           const std::string& place) {
  Response response;
  response.converged = motion.converged;
  response.contacts = motion.contacts;
  response.contact = motion.contact;
  response.periods = sweep.periods;
  response.phases = motion.near;
  RecordFigure picture{motion.name, motion_figure(scene, response, motion.place),
                       "the motion of the curve " + place};
  picture.figure.title = "Motion " + place + (motion.converged ? "" : " (NOT CONVERGED)");
  record.motion_pictures.push_back(std::move(picture));
}

/// The instants of contact of all motions of which they are known.
void append_contact_instants(Record& record, const Scene& scene, const std::vector<CurveMotion>& motions) {
  Table all;
  for (const CurveMotion& motion : motions) {
    if (!motion.near) continue;
    const Table phases = phases_table(scene, motion.near->motion);
    std::vector<std::string> columns{"file"};
    columns.insert(columns.end(), phases.columns().begin(), phases.columns().end());
    if (all.columns().empty()) all = Table(columns);
    for (std::size_t i = 0; i < phases.rows(); ++i) {
      std::vector<Cell> row{motion.name + ".csv"};
      for (const Cell& cell : phases.row(i)) row.push_back(cell);
      all.append_row(std::move(row));
    }
  }
  if (!all.columns().empty()) record.summary.emplace_back(quantities::phases, std::move(all));
}

}  // namespace

void append_motions(Record& record, const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const std::vector<CurveMotion>& motions) {
  if (scene.analysis.motion_at.empty()) return;
  const SweepAxis axis = sweep_axis(sweep);
  const bool with_phases = std::any_of(motions.begin(), motions.end(),
                                       [](const CurveMotion& motion) { return motion.phases.has_value(); });
  Summary measures;
  append_motion(measures, scene, {}, 0);
  std::vector<std::string> columns{"file", "at", axis.column()};
  for (const Entry& one : measures) columns.push_back(one.name);
  for (const Quantity& one : {quantities::unstable_multipliers, quantities::residual, quantities::converged})
    columns.push_back(one.column());
  if (with_phases)
    for (std::string& column : phases_columns()) columns.push_back(std::move(column));
  Table table(columns);
  for (const CurveMotion& motion : motions) {
    table.append_row(row_of(scene, motion, with_phases));
    append_files(record, scene, model, motion, place_of(motion, axis));
    append_motion_picture(record, scene, sweep, motion, place_of(motion, axis));
    if (!motion.converged)
      record.warnings.push_back("The motion " + place_of(motion, axis) +
                                " was not solved for to the tolerance: " + motion.name +
                                ".csv holds the last iterate.");
  }
  if (!sweep.motions_left_out.empty())
    record.warnings.push_back(
        fmt::format("analysis.motion_at: the sweep was interrupted before these motions were solved for: {}.",
                    fmt::join(sweep.motions_left_out, ", ")));
  for (const double place : scene.analysis.motion_at.places)
    if (sweep.motions_left_out.empty() &&
        std::none_of(motions.begin(), motions.end(), [&](const CurveMotion& motion) {
          return motion.at == axis.quantity && motion.place == place;
        }))
      record.warnings.push_back(
          fmt::format("analysis.motion_at: the curve does not reach {} {}; no motion is written for it.",
                      cell_text(place), axis.unit));
  record.summary.emplace_back(quantities::motions, std::move(table));
  append_contact_instants(record, scene, motions);
}

}  // namespace wavebalance::app
