#include "results/curve_motion_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drawing/record_figure.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "results/motion_files.hpp"
#include "results/orbit_record.hpp"
#include "results/quantities.hpp"
#include "results/summary_parts.hpp"
#include "results/sweep_record.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::app {
namespace {

Summary motion_row(const Scene& scene, const CurveMotion& motion, const SweepAxis& axis, bool with_phases) {
  Summary row{{"file", motion.name + ".csv"}, {"at", motion.at}, {axis.column(), motion.place}};
  append_motion(row, scene, motion.contacts, motion.contact);
  row.emplace_back(quantities::unstable_multipliers,
                   motion.stability.unstable < 0 ? missing : double(motion.stability.unstable));
  row.emplace_back(quantities::residual, motion.residual);
  row.emplace_back(quantities::converged, motion.converged);
  if (with_phases) append_phases(row, motion.phases);
  return row;
}

std::string place_of(const CurveMotion& motion, const SweepAxis& axis) {
  if (motion.at == axis.quantity) return fmt::format("at {} {}", cell_text(motion.place), axis.unit);
  return fmt::format("at the {}, {:.7g} {}", spaced_words(motion.at), motion.place, axis.unit);
}

/// The motion as that of a single response, with the instants of contact where these are known.
void append_motion_picture(Record& record, const Scene& scene, const Sweep& sweep, const CurveMotion& motion,
                           const std::string& place) {
  Response response;
  response.converged = motion.converged;
  response.contacts = motion.contacts;
  response.contact = motion.contact;
  response.periods = sweep.periods;
  if (sweep.curve.parameter == solvers::SweepParameter::frequency) response.load_frequency = motion.place;
  response.phases = motion.near;
  RecordPicture picture{motion.name, motion_figure(scene, response, motion.place),
                        "motion of the curve " + place};
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
  if (!all.columns().empty()) record.add(quantities::phases, std::move(all));
}

}  // namespace

void append_motions(Record& record, const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const std::vector<CurveMotion>& motions) {
  if (scene.analysis.motion_at.empty()) return;
  const SweepAxis axis = sweep_axis(sweep);
  const bool with_phases = std::any_of(motions.begin(), motions.end(),
                                       [](const CurveMotion& motion) { return motion.phases.has_value(); });
  std::vector<Summary> rows;
  for (const CurveMotion& motion : motions) {
    rows.push_back(motion_row(scene, motion, axis, with_phases));
    append_motion_files(record, scene, model, {motion.contacts, motion.contact, motion.structure},
                        motion.name, "motion of the curve " + place_of(motion, axis));
    append_motion_picture(record, scene, sweep, motion, place_of(motion, axis));
    if (!motion.converged)
      record.warnings.push_back("The motion " + place_of(motion, axis) +
                                " was not solved for to the tolerance: " + motion.name +
                                ".csv holds the last iterate.");
  }
  if (!sweep.motions_left_out.empty())
    warn(record, "analysis.motion_at: the sweep was interrupted before these motions were computed: {}.",
         fmt::join(sweep.motions_left_out, ", "));
  for (const double place : scene.analysis.motion_at.places)
    if (sweep.motions_left_out.empty() &&
        std::none_of(motions.begin(), motions.end(), [&](const CurveMotion& motion) {
          return motion.at == axis.quantity && motion.place == place;
        }))
      warn(record, "analysis.motion_at: the curve does not reach {} {}; no motion is written for it.",
           cell_text(place), axis.unit);
  record.add(quantities::motions, table_of(rows));
  append_contact_instants(record, scene, motions);
  append_orbits(record, scene, motions);
}

}  // namespace wavebalance::app
