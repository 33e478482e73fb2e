#include "blade_motion.hpp"

#include <algorithm>
#include <cmath>

#include "wavebalance/fem/boundary_faces.hpp"

namespace wavebalance::blade {
std::vector<Eigen::Matrix3Xd> motion(const app::ModeStudy& study, const solvers::ModePoint& point,
                                     int times) {
  const Eigen::MatrixXd whole = study.model().recover(study.structure_motion(point, times).displacement);
  std::vector<Eigen::Matrix3Xd> frames;
  for (Eigen::Index frame = 0; frame < whole.cols(); ++frame)
    frames.push_back(study.model().blade->model.displacements(whole.col(frame)));
  return frames;
}

double TipMotion::rotation_share() const {
  const double rotated = rotation * rotation * radius * radius;
  return rotated / (rotated + translation.squaredNorm());
}

TipMotion tip_motion(const fem::Blade& blade, const Eigen::Matrix3Xd& displacements) {
  const Eigen::Matrix2Xd at = blade.model.mesh.nodes(Eigen::all, blade.contact_nodes).topRows(2);
  const Eigen::Matrix2Xd u = displacements(Eigen::all, blade.contact_nodes).topRows(2);
  const Eigen::Matrix2Xd arm = at.colwise() - at.rowwise().mean();
  const double moment = (arm.row(0).cwiseProduct(u.row(1)) - arm.row(1).cwiseProduct(u.row(0))).mean();
  const double inertia = arm.colwise().squaredNorm().mean();
  return {u.rowwise().mean(), moment / inertia, std::sqrt(inertia)};
}

double twist_amplitude(const fem::Blade& blade, const std::vector<Eigen::Matrix3Xd>& motion) {
  double least = 0.0, largest = 0.0;
  for (std::size_t frame = 0; frame < motion.size(); ++frame) {
    const double rotation = tip_motion(blade, motion[frame]).rotation;
    least = frame == 0 ? rotation : std::min(least, rotation);
    largest = frame == 0 ? rotation : std::max(largest, rotation);
  }
  return 0.5 * (largest - least);
}

std::vector<bool> torsion_modes(const app::ModeStudy& study) {
  const auto& model = study.model();
  const Eigen::MatrixXd shapes = model.recover(study.linear_shapes());
  std::vector<bool> torsion;
  for (Eigen::Index mode = 0; mode < shapes.cols(); ++mode) {
    const auto shape = model.blade->model.displacements(shapes.col(mode));
    torsion.push_back(tip_motion(*model.blade, shape).rotation_share() > 0.5);
  }
  return torsion;
}

double torsion_share(const std::vector<bool>& torsion, const solvers::ModePoint& point) {
  double all = 0.0, share = 0.0;
  for (Eigen::Index n = 1; n < point.amplitudes.cols(); ++n)
    for (Eigen::Index mode = 0; mode < point.amplitudes.rows(); ++mode) {
      const double energy = static_cast<double>(n * n) * std::norm(point.amplitudes(mode, n));
      all += energy;
      if (torsion[static_cast<std::size_t>(mode)]) share += energy;
    }
  return share / all;
}

EdgeContact edge_contact(const Eigen::MatrixXd& force) {
  EdgeContact contact;
  const Eigen::Index half = force.rows() / 2;
  for (Eigen::Index k = 0; k < force.cols(); ++k) {
    const double time = static_cast<double>(k) / static_cast<double>(force.cols());
    if (force.col(k).head(half).maxCoeff() > 0.0) contact.leading.push_back(time);
    if (force.col(k).tail(half).maxCoeff() > 0.0) contact.trailing.push_back(time);
  }
  return contact;
}

Surface surface(const fem::Blade& blade, const Eigen::Matrix3Xd& displacements, double scale) {
  constexpr double mm = 1e3;
  const fem::SolidMesh& mesh = blade.model.mesh;
  Surface surface;
  surface.vertices = mm * mesh.nodes;
  if (displacements.size() > 0) surface.vertices += mm * scale * displacements;
  const fem::Connectivity faces = fem::boundary_faces(mesh);
  for (int face = 0; face < faces.cols(); ++face) surface.faces.push_back(fem::around(faces, face));
  return surface;
}

}  // namespace wavebalance::blade
