#include "results/motion_files.hpp"

#include <fmt/format.h>

#include <span>
#include <sstream>
#include <utility>

#include "wavebalance/app/page/assets.hpp"
#include "wavebalance/app/page/body.hpp"
#include "wavebalance/app/results/tables.hpp"
#include "wavebalance/fem/matrix_market.hpp"
#include "wavebalance/fem/vtu.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* about_motion = "motion of the whole structure";

template <class Mesh>
std::string vtu_text(const Mesh& mesh, std::span<const fem::PointField> fields) {
  std::ostringstream text;
  fem::write_vtu(text, mesh, fields);
  return std::move(text).str();
}

std::string vtu_text(const fem::SolidModel& solid, const Eigen::Matrix3Xd& displacement) {
  const fem::PointField fields[] = {{"displacement", displacement},
                                    {"stress", fem::nodal_stress(solid, displacement)}};
  return vtu_text(solid.mesh, fields);
}

std::string vtu_text(const MovedMesh& moved, const Eigen::Matrix3Xd& displacement) {
  const fem::PointField fields[] = {{"displacement", displacement}};
  return vtu_text(moved.mesh, fields);
}

std::string array_text(const Eigen::MatrixXd& whole) {
  std::ostringstream text;
  fem::write_matrix_market_array(
      text, whole,
      "displacement of every degree of freedom (row) at uniform instants of the period (column), m");
  return std::move(text).str();
}

/// A file for each frame, their series, and the body that the page moves; of many points it would be a page
/// that no browser opens.
template <class Moving>
void append_mesh_files(std::vector<RecordFile>& files, const Moving& moving, const fem::Mesh& mesh,
                       std::vector<Eigen::Matrix3Xd> frames, const std::string& name) {
  std::vector<fem::PvdEntry> entries;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    files.push_back(
        {fmt::format("{}_{:04}.vtu", name, frame), vtu_text(moving, frames[frame]), about_motion});
    entries.push_back({double(frame) / double(frames.size()), files.back().name});
  }
  std::ostringstream series;
  fem::write_pvd(series, entries);
  files.push_back({name + ".pvd", std::move(series).str(), about_motion});
  constexpr Eigen::Index most = 1'000'000;  // points times instants
  if (!available(Library::three) || mesh.points.cols() * std::ssize(frames) > most) return;
  MovingBody body{name, mesh.points, fem::surface_of(mesh), std::move(frames)};
  body.times = exaggeration(body);
  files.push_back({name + ".body.js", body_script(name, body), "the moving body of report.html"});
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
  files.push_back({name + ".mtx", array_text(whole), about_motion});
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

}  // namespace wavebalance::app
