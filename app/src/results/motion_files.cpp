#include "results/record_parts.hpp"

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/page/assets.hpp"
#include "wavebalance/app/page/body.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/fem/matrix_market.hpp"
#include "wavebalance/fem/vtu.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* about_motion = "motion of the whole structure";

std::string frame_text(const fem::Mesh& mesh, const fem::SolidModel& solid,
                       const Eigen::Matrix3Xd& displacement) {
  const fem::PointField fields[] = {{"displacement", displacement},
                                    {"stress", fem::nodal_stress(solid, displacement)}};
  return fem::vtu_text(mesh, fields);
}

std::string frame_text(const fem::Mesh& mesh, const MovedMesh&, const Eigen::Matrix3Xd& displacement) {
  const fem::PointField fields[] = {{"displacement", displacement}};
  return fem::vtu_text(mesh, fields);
}

/// A file for each frame, their series, and the body that the page moves; of many points it would be a page
/// that no browser opens.
template <class Moving>
void append_mesh_files(std::vector<RecordFile>& files, const Moving& moving, const fem::Mesh& mesh,
                       std::vector<Eigen::Matrix3Xd> frames, const std::string& name) {
  std::vector<fem::PvdEntry> entries;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    files.push_back(
        {fmt::format("{}_{:04}.vtu", name, frame), frame_text(mesh, moving, frames[frame]), about_motion});
    entries.push_back({double(frame) / double(frames.size()), files.back().name});
  }
  files.push_back({name + ".pvd", fem::pvd_text(entries), about_motion});
  constexpr Eigen::Index most = 1'000'000;  // points times instants
  if (!available(Library::three) || mesh.points.cols() * std::ssize(frames) > most) return;
  MovingBody body{name, mesh.points, fem::surface_of(mesh), std::move(frames)};
  body.times = exaggeration(body);
  files.push_back({name + ".body.js", body_script(name, body), "the moving body of report.html"});
}

Summary motion_row(const Scene& scene, const CurveMotion& motion, const SweepAxis& axis, bool with_exact) {
  Summary row{{"file", motion.name + ".csv"}, {"at", motion.at}, {axis.column(), motion.place}};
  append_motion(row, scene, motion.contacts, motion.contact);
  row.emplace_back(quantities::unstable_multipliers,
                   motion.stability.unstable < 0 ? missing : double(motion.stability.unstable));
  row.emplace_back(quantities::residual, motion.residual);
  row.emplace_back(quantities::converged, motion.converged);
  if (with_exact) append_exact(row, motion.exact);
  return row;
}

std::string place_of(const CurveMotion& motion, const SweepAxis& axis) {
  if (motion.at == axis.quantity) return "at " + quantity(motion.place, axis.unit, 7);
  return fmt::format("at the {}, {}", spaced_words(motion.at), quantity(motion.place, axis.unit, 7));
}

/// The motion as of a single response, with the instants of contact if known.
void append_motion_picture(Record& record, const Scene& scene, const Sweep& sweep, const CurveMotion& motion,
                           const std::string& place) {
  Response response;
  response.converged = motion.converged;
  response.contacts = motion.contacts;
  response.contact = motion.contact;
  response.periods = sweep.periods;
  if (sweep.curve.parameter == solvers::SweepParameter::frequency) response.load_frequency = motion.place;
  response.exact = motion.near;
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
    const Table exact = intervals_table(scene, motion.near->motion);
    std::vector<std::string> columns{"file"};
    columns.insert(columns.end(), exact.columns().begin(), exact.columns().end());
    if (all.columns().empty()) all = Table(columns);
    for (std::size_t i = 0; i < exact.rows(); ++i) {
      std::vector<Cell> row{motion.name + ".csv"};
      for (const Cell& cell : exact.row(i)) row.push_back(cell);
      all.append_row(std::move(row));
    }
  }
  if (!all.columns().empty()) record.add(quantities::contact_intervals, std::move(all));
}

}  // namespace

std::vector<RecordFile> motion_files(const StructureModel& model, const Eigen::MatrixXd& coordinates,
                                     const std::string& name) {
  std::vector<RecordFile> files;
  if (coordinates.cols() == 0) return files;
  const Eigen::MatrixXd whole = model.recover(coordinates);
  std::vector<Eigen::Matrix3Xd> frames;
  if (model.blade) {
    const fem::SolidModel& solid = model.blade->model;
    for (const auto& unknowns : whole.colwise()) frames.push_back(solid.displacements(unknowns));
    append_mesh_files(files, solid, fem::mesh_of(solid.mesh), std::move(frames), name);
    return files;
  }
  constexpr const char* rows =
      "displacement of every degree of freedom (row) at uniform instants of the period (column), m";
  files.push_back({name + ".mtx", fem::matrix_market_text(whole, rows), about_motion});
  if (!model.mesh) return files;
  for (const auto& unknowns : whole.colwise()) {
    const Eigen::VectorXd moved = model.mesh->displacements * unknowns;
    frames.emplace_back(moved.reshaped(3, moved.size() / 3));
  }
  append_mesh_files(files, *model.mesh, model.mesh->mesh, std::move(frames), name);
  return files;
}

void append_motion_files(Record& record, const Scene& scene, const StructureModel& model,
                         const WrittenMotion& motion, const std::string& name, const std::string& about) {
  const bool several = motion.contacts.rows() > 1;
  record.files.push_back({name + ".csv", csv_text(response_table(motion.contacts.contact(motion.contact))),
                          about + (several ? ": the contact with the largest force" : "")});
  if (several)
    record.files.push_back({name + "_contacts.csv", csv_text(contacts_table(scene, motion.contacts)),
                            about + ": every contact"});
  if (!motion.impacts.columns().empty())
    record.files.push_back({name + "_impacts.csv", csv_text(motion.impacts), about + ": its impacts"});
  for (RecordFile& file : motion_files(model, motion.structure, name)) {
    file.about = about + ": the whole structure";
    record.files.push_back(std::move(file));
  }
}

void append_motions(Record& record, const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const std::vector<CurveMotion>& motions) {
  if (scene.analysis.motion_at.empty()) return;
  const SweepAxis axis = sweep_axis(sweep);
  const bool with_exact =
      std::ranges::any_of(motions, [](const CurveMotion& motion) { return motion.exact.has_value(); });
  std::vector<Summary> rows;
  for (const CurveMotion& motion : motions) {
    rows.push_back(motion_row(scene, motion, axis, with_exact));
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
    if (sweep.motions_left_out.empty() && std::ranges::none_of(motions, [&](const CurveMotion& motion) {
          return motion.at == axis.quantity && motion.place == place;
        }))
      warn(record, "analysis.motion_at: the curve does not reach {} {}; no motion is written for it.",
           cell_text(place), axis.unit);
  record.add(quantities::motions, table_of(rows));
  append_contact_instants(record, scene, motions);
  append_orbits(record, scene, motions);
}

}  // namespace wavebalance::app
