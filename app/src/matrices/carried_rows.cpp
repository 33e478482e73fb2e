#include "matrices/carried_rows.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cstdlib>

#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/fem/craig_bampton.hpp"

namespace wavebalance::app {
namespace {

/// The directions of contact among the rows that move, contacts x moving.
Eigen::MatrixXd directions_of_base(const Scene& scene, const StructureFiles& files) {
  const std::vector<SceneContact> contacts = contact_places(scene);
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(std::ssize(contacts), std::ssize(files.moving));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < contacts[i].dofs.size(); ++j) {
      const auto place = std::ranges::lower_bound(files.moving, contacts[i].dofs[j] - 1);
      if (place != files.moving.end() && *place == contacts[i].dofs[j] - 1)
        directions(Eigen::Index(i), place - files.moving.begin()) += contacts[i].coefficients[j];
    }
  return directions;
}

}  // namespace

Eigen::MatrixXd carried_rows(const Scene& scene, const StructureFiles& files) {
  if (files.moving.empty()) return {};
  const Eigen::MatrixXd base = directions_of_base(scene, files);
  if (base.isZero(0.0)) return {};
  const solvers::ContactDirections directions = contact_directions(scene, files);
  const std::vector<int> touched = fem::touched_unknowns(directions);
  const Eigen::MatrixXd own = Eigen::MatrixXd(directions)(Eigen::all, touched);
  const Eigen::MatrixXd least = own.completeOrthogonalDecomposition().solve(-base);
  const double rounding = 100.0 * std::numeric_limits<double>::epsilon() * base.norm();
  if (!((own * least + base).norm() <= rounding))
    throw StructureFault(
        "contact.pairs",
        "contacts touch rows that a base displacement moves, and their own rows cannot follow "
        "them all; expected contacts whose other rows differ, or have none of the base");
  Eigen::MatrixXd carried = Eigen::MatrixXd::Zero(std::ssize(files.rows), std::ssize(files.moving));
  carried(touched, Eigen::all) = least;
  return carried;
}

Eigen::VectorXd carried_by(const ForcingTerm& term, const Eigen::MatrixXd& carried,
                           const StructureFiles& files) {
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(carried.rows());
  for (const int dof : term.dofs) {
    const auto place = std::ranges::lower_bound(files.moving, std::abs(dof) - 1) - files.moving.begin();
    displacement += (dof > 0 ? 1.0 : -1.0) * carried.col(place);
  }
  return displacement;
}

void check_carried(const Scene& scene, const StructureFiles& files) {
  if (carried_rows(scene, files).size() == 0) return;
  const auto refuse = [](bool given, const char* key, const char* expected) {
    if (given)
      throw StructureFault(
          key,
          std::string("not with a contact at a row that a base displacement moves; expected ") + expected);
  };
  const Structure& structure = scene.structure;
  refuse(structure.modal_damping > 0.0, "structure.modal_damping", "0, or structure.damping");
  refuse(structure.loss_factor > 0.0, "structure.loss_factor", "0, or structure.damping");
  refuse(!structure.matrices.gyroscopic.empty(), "structure.gyroscopic", "none");
  refuse(!structure.matrices.spin_stiffness.empty(), "structure.spin_stiffness", "none");
  refuse(scene.analysis.motion_points > 0, "analysis.motion_points", "none, or analysis.outputs");
}

}  // namespace wavebalance::app
