#include "wavebalance/fem/centrifugal.hpp"

#include "dense.hpp"
#include "hexahedron.hpp"
#include "require.hpp"
#include "symmetric_factor.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Eigen::Matrix3d projection_across(const RotationAxis& axis) {
  const double length = axis.direction.norm();
  detail::require_positive("centrifugal_stiffness", "the length of axis.direction", length);
  detail::require(axis.point.allFinite(), "centrifugal_stiffness",
                  "axis.point has an entry that is not finite");
  const Eigen::Vector3d unit = axis.direction / length;
  return Eigen::Matrix3d::Identity() - unit * unit.transpose();
}

void drop_zeros(Sparse& matrix) {
  matrix.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
}

// Positions are interpolated like displacements, so the load is the mass times the distances of the nodes.
Eigen::VectorXd centrifugal_load(const SolidModel& model, const Assembly& assembly,
                                 const Eigen::Matrix3d& across, const Eigen::Vector3d& point) {
  return assembly.vector([&](int index) -> Eigen::VectorXd {
    const Eigen::Matrix3Xd coordinates = model.mesh.coordinates(index);
    const Eigen::MatrixXd mass = detail::scalar_mass(model.mesh.element, coordinates, model.material.density);
    const Eigen::Matrix3Xd arms = across * (coordinates.colwise() - point);
    return detail::product(arms, mass).reshaped();
  });
}

// The sum of dN_i/dx_a sigma_ab dN_j/dx_b for the functions of the nodes, in each direction alike.
Eigen::MatrixXd geometric_matrix(const SolidModel& model, int index, const Eigen::Matrix3Xd& displacements) {
  const SolidElement element = model.mesh.element;
  const Eigen::Matrix3Xd coordinates = model.mesh.coordinates(index);
  const auto samples = detail::sample(element, coordinates, detail::stiffness_rule(element));
  const Eigen::Matrix3Xd moved = displacements(Eigen::all, model.mesh.elements.col(index));
  const auto stress = detail::stress_at(
      samples, model.material, detail::with_incompatible_modes(element, coordinates, model.material, moved));
  constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  const Eigen::Index nodes = coordinates.cols();
  Eigen::MatrixXd scalar = Eigen::MatrixXd::Zero(nodes, nodes);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const Eigen::VectorXd weights = samples.volumes.cwiseProduct(stress.row(component[a][b]).transpose());
      scalar += detail::product_transposed(samples.gradients[a].topRows(nodes) * weights.asDiagonal(),
                                           samples.gradients[b].topRows(nodes));
    }
  return detail::expand_by_block((scalar + scalar.transpose()) / 2.0, Eigen::Matrix3d::Identity());
}

}  // namespace

Sparse CentrifugalStiffness::stiffness(const Sparse& at_rest, double speed) const {
  detail::require_square(at_rest, "CentrifugalStiffness::stiffness", "at_rest", geometric.rows());
  detail::require_value(std::isfinite(speed), "CentrifugalStiffness::stiffness", "speed", speed, "finite");
  return at_rest + speed * speed * (geometric - softening);
}

CentrifugalStiffness centrifugal_stiffness(const SolidModel& model, const Sparse& stiffness,
                                           const RotationAxis& axis) {
  const Eigen::Matrix3d across = projection_across(axis);
  const Assembly assembly = model.assembly();
  detail::require_square(stiffness, "centrifugal_stiffness", "stiffness", model.dofs.count());
  const detail::SymmetricFactor factor(stiffness);
  if (!factor.positive_definite())
    throw std::domain_error("centrifugal_stiffness: the stiffness is not positive definite");
  CentrifugalStiffness result;
  result.displacement = factor.solve(centrifugal_load(model, assembly, across, axis.point));
  const Eigen::Matrix3Xd displacements = model.displacements(result.displacement);
  result.geometric =
      assembly.matrix([&](int index) { return geometric_matrix(model, index, displacements); });
  result.softening = assembly.matrix([&](int index) {
    return detail::expand_by_block(
        detail::scalar_mass(model.mesh.element, model.mesh.coordinates(index), model.material.density),
        across);
  });
  drop_zeros(result.geometric);
  drop_zeros(result.softening);
  return result;
}

}  // namespace wavebalance::fem
