#include "results/motion_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <utility>

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

}  // namespace

std::vector<RecordFile> motion_files(const StructureModel& model, const Eigen::MatrixXd& coordinates,
                                     const std::string& name) {
  if (coordinates.cols() == 0) return {};
  const Eigen::MatrixXd whole = model.recover(coordinates);
  if (model.blade) return mesh_files(model.blade->model, whole, name);
  std::vector<RecordFile> files{{name + ".mtx", array_text(whole), about_motion}};
  if (model.mesh) {
    std::vector<RecordFile> of_mesh = mesh_files(*model.mesh, whole, name);
    std::move(of_mesh.begin(), of_mesh.end(), std::back_inserter(files));
  }
  return files;
}

}  // namespace wavebalance::app
