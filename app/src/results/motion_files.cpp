#include "results/motion_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <utility>

#include "wavebalance/app/page/assets.hpp"
#include "wavebalance/app/page/body.hpp"
#include "wavebalance/fem/matrix_market.hpp"
#include "wavebalance/fem/vtu.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* about_motion = "motion of the whole structure";

std::string vtu_text(const fem::SolidModel& solid, const Eigen::VectorXd& unknowns) {
  const Eigen::Matrix3Xd displacement = solid.displacements(unknowns);
  const std::array<fem::PointField, 2> fields{
      {{"displacement", displacement}, {"stress", fem::nodal_stress(solid, displacement)}}};
  std::ostringstream text;
  fem::write_vtu(text, solid.mesh, fields);
  return std::move(text).str();
}

std::string vtu_text(const MovedMesh& moved, const Eigen::VectorXd& unknowns) {
  const Eigen::VectorXd displacement = moved.displacements * unknowns;
  const std::array<fem::PointField, 1> fields{
      {{"displacement", displacement.reshaped(3, displacement.size() / 3)}}};
  std::ostringstream text;
  fem::write_vtu(text, moved.mesh, fields);
  return std::move(text).str();
}

/// A file for each column of the motion, and their series.
template <class Moving>
std::vector<RecordFile> mesh_files(const Moving& moving, const Eigen::MatrixXd& whole,
                                   const std::string& name) {
  std::vector<RecordFile> files;
  std::vector<fem::PvdEntry> entries;
  for (Eigen::Index frame = 0; frame < whole.cols(); ++frame) {
    files.push_back(
        {fmt::format("{}_{:04}.vtu", name, frame), vtu_text(moving, whole.col(frame)), about_motion});
    entries.push_back({static_cast<double>(frame) / static_cast<double>(whole.cols()), files.back().name});
  }
  std::ostringstream series;
  fem::write_pvd(series, entries);
  files.push_back({name + ".pvd", std::move(series).str(), about_motion});
  return files;
}

std::string array_text(const Eigen::MatrixXd& whole) {
  std::ostringstream text;
  fem::write_matrix_market_array(
      text, whole,
      "displacement of every degree of freedom (row) at uniform instants of the period (column), m");
  return std::move(text).str();
}

/// The body that the page moves; of many points it would be a page that no browser opens.
std::vector<RecordFile> body_file(const fem::Mesh& mesh, std::vector<Eigen::Matrix3Xd> frames,
                                  const std::string& name) {
  constexpr Eigen::Index most = 1'000'000;  // points times instants
  if (!available(Library::three) || mesh.points.cols() * std::ssize(frames) > most) return {};
  MovingBody body{name, mesh.points, fem::surface_of(mesh), std::move(frames)};
  body.times = exaggeration(body);
  return {{name + ".body.js", body_script(name, body), "the moving body of report.html"}};
}

template <class Displacements>
std::vector<Eigen::Matrix3Xd> frames_of(const Eigen::MatrixXd& whole, const Displacements& displacements) {
  std::vector<Eigen::Matrix3Xd> frames;
  for (Eigen::Index frame = 0; frame < whole.cols(); ++frame)
    frames.push_back(displacements(whole.col(frame)));
  return frames;
}

void append(std::vector<RecordFile>& files, std::vector<RecordFile> more) {
  std::move(more.begin(), more.end(), std::back_inserter(files));
}

}  // namespace

std::vector<RecordFile> motion_files(const StructureModel& model, const Eigen::MatrixXd& coordinates,
                                     const std::string& name) {
  if (coordinates.cols() == 0) return {};
  const Eigen::MatrixXd whole = model.recover(coordinates);
  if (model.blade) {
    const fem::SolidModel& solid = model.blade->model;
    std::vector<RecordFile> files = mesh_files(solid, whole, name);
    const auto displacements = [&](const Eigen::VectorXd& unknowns) { return solid.displacements(unknowns); };
    append(files, body_file(fem::mesh_of(solid.mesh), frames_of(whole, displacements), name));
    return files;
  }
  std::vector<RecordFile> files{{name + ".mtx", array_text(whole), about_motion}};
  if (!model.mesh) return files;
  append(files, mesh_files(*model.mesh, whole, name));
  const auto displacements = [&](const Eigen::VectorXd& unknowns) {
    const Eigen::VectorXd moved = model.mesh->displacements * unknowns;
    return Eigen::Matrix3Xd(moved.reshaped(3, moved.size() / 3));
  };
  append(files, body_file(model.mesh->mesh, frames_of(whole, displacements), name));
  return files;
}

}  // namespace wavebalance::app
