#include "wavebalance/fem/solid.hpp"

#include "dense.hpp"
#include "hexahedron.hpp"
#include "require.hpp"

namespace wavebalance::fem {
namespace {

// Calls a function that computes something for one element; its errors get the number of the element.
template <typename Function>
auto on_element(int index, Function&& function) {
  try {
    return function();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("element " + std::to_string(index) + ": " + error.what());
  }
}

// Trilinear extension of values at the 2 x 2 x 2 Gauss points: 8 x k weights.
Eigen::MatrixXd extension_to_nodes(SolidElement element) {
  const Eigen::Matrix3Xd nodes = detail::natural_nodes(element);
  const Eigen::Matrix3Xd signs = detail::gauss_rule(2).points * std::sqrt(3.0);
  Eigen::MatrixXd weights(8, nodes.cols());
  for (Eigen::Index node = 0; node < nodes.cols(); ++node)
    for (Eigen::Index p = 0; p < 8; ++p)
      weights(p, node) = (1.0 + std::sqrt(3.0) * signs.col(p).array() * nodes.col(node).array()).prod() / 8.0;
  return weights;
}

}  // namespace

int nodes_per_element(SolidElement element) { return element == SolidElement::hexahedron8 ? 8 : 20; }

void SolidMaterial::validate() const {
  detail::require_positive("SolidMaterial", "youngs_modulus", youngs_modulus);
  detail::require_value(poissons_ratio > -1.0 && poissons_ratio < 0.5, "SolidMaterial", "poissons_ratio",
                        poissons_ratio, "in (-1, 1/2)");
  detail::require_positive("SolidMaterial", "density", density);
}

Eigen::Matrix3Xd SolidMesh::coordinates(int index) const {
  if (index < 0 || index >= elements.cols())
    throw std::out_of_range("SolidMesh: element " + std::to_string(index) + " is not in 0.." +
                            std::to_string(elements.cols() - 1));
  return nodes(Eigen::all, elements.col(index));
}

void SolidMesh::validate() const {
  detail::require_value(elements.cols() >= 1, "SolidMesh", "the number of elements", 0, "at least 1");
  detail::require_count("SolidMesh", "the number of rows of elements", elements.rows(),
                        nodes_per_element(element));
  detail::require(nodes.allFinite(), "SolidMesh", "nodes has a coordinate that is not finite");
  for (Eigen::Index index = 0; index < elements.cols(); ++index)
    for (int node : elements.col(index))
      if (node < 0 || node >= nodes.cols())
        detail::reject_value("SolidMesh", "a node of element " + std::to_string(index), node,
                             "in 0.." + std::to_string(nodes.cols() - 1));
}

Eigen::MatrixXd element_stiffness(SolidElement element, const Eigen::Matrix3Xd& coordinates,
                                  const SolidMaterial& material) {
  material.validate();
  const detail::Samples samples = detail::sample(element, coordinates, detail::stiffness_rule(element));
  const Eigen::MatrixXd full = detail::elastic_matrix(samples, material);
  if (element != SolidElement::hexahedron8) return full;
  const Eigen::MatrixXd coupling = full.bottomLeftCorner(9, 24);
  const Eigen::MatrixXd condensed =
      full.topLeftCorner(24, 24) -
      detail::transposed_product(coupling, detail::cholesky_solve(full.bottomRightCorner(9, 9), coupling));
  return (condensed + condensed.transpose()) / 2.0;
}

Eigen::MatrixXd element_mass(SolidElement element, const Eigen::Matrix3Xd& coordinates,
                             const SolidMaterial& material) {
  material.validate();
  return detail::expand_by_block(detail::scalar_mass(element, coordinates, material.density),
                                 Eigen::Matrix3d::Identity());
}

Eigen::Matrix3Xd SolidModel::displacements(const Eigen::VectorXd& unknowns) const {
  return dofs.expand(unknowns).reshaped(3, mesh.nodes.cols());
}

Assembly SolidModel::assembly() const {
  mesh.validate();
  material.validate();
  detail::require_count("SolidModel", "the number of dofs", dofs.dofs(), 3 * mesh.nodes.cols());
  Connectivity unknowns(3 * mesh.elements.rows(), mesh.elements.cols());
  for (Eigen::Index index = 0; index < mesh.elements.cols(); ++index)
    for (Eigen::Index i = 0; i < unknowns.rows(); ++i)
      unknowns(i, index) = dofs.unknown(3 * mesh.elements(i / 3, index) + static_cast<int>(i % 3));
  return Assembly(dofs.count(), std::move(unknowns));
}

SolidModel hold_nodes(SolidMesh mesh, const SolidMaterial& material, const std::vector<int>& nodes) {
  mesh.validate();
  material.validate();
  std::vector<int> held;
  for (int node : nodes) {
    detail::require_value(node >= 0 && node < mesh.nodes.cols(), "hold_nodes", "an entry of nodes", node,
                          "in 0.." + std::to_string(mesh.nodes.cols() - 1));
    for (int axis = 0; axis < 3; ++axis) held.push_back(3 * node + axis);
  }
  const FreeDofs dofs(3 * static_cast<int>(mesh.nodes.cols()), held);
  return {std::move(mesh), material, dofs};
}

Matrices solid_matrices(const SolidModel& model, double stiffness_damping) {
  detail::require_not_negative("solid_matrices", "stiffness_damping", stiffness_damping);
  const Assembly assembly = model.assembly();
  const SolidMesh& mesh = model.mesh;
  Matrices matrices;
  matrices.stiffness = assembly.matrix([&](int index) {
    return on_element(
        index, [&] { return element_stiffness(mesh.element, mesh.coordinates(index), model.material); });
  });
  matrices.mass = assembly.matrix([&](int index) {
    return on_element(index,
                      [&] { return element_mass(mesh.element, mesh.coordinates(index), model.material); });
  });
  // Directions do not share mass: two thirds of the pattern are zeros.
  matrices.mass.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  if (stiffness_damping > 0.0)
    matrices.damping = stiffness_damping * matrices.stiffness;
  else
    matrices.damping.resize(matrices.stiffness.rows(), matrices.stiffness.cols());  // without entries
  return matrices;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> nodal_stress(const SolidModel& model,
                                                      const Eigen::Matrix3Xd& displacements) {
  const SolidMesh& mesh = model.mesh;
  mesh.validate();
  model.material.validate();
  detail::require_count("nodal_stress", "the number of columns of displacements", displacements.cols(),
                        mesh.nodes.cols());
  const Eigen::MatrixXd extension = extension_to_nodes(mesh.element);
  Eigen::Matrix<double, 6, Eigen::Dynamic> sum =
      Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, mesh.nodes.cols());
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(mesh.nodes.cols());
  for (int index = 0; index < mesh.elements.cols(); ++index) {
    const Eigen::Matrix3Xd coordinates = mesh.coordinates(index);
    const Eigen::Matrix3Xd moved = displacements(Eigen::all, mesh.elements.col(index));
    const auto coefficients =
        detail::with_incompatible_modes(mesh.element, coordinates, model.material, moved);
    const auto samples = detail::sample(mesh.element, coordinates, detail::gauss_rule(2));
    sum(Eigen::all, mesh.elements.col(index)) +=
        detail::product(detail::stress_at(samples, model.material, coefficients), extension);
    for (int node : mesh.elements.col(index)) shares[node] += 1.0;
  }
  return sum * shares.cwiseMax(1.0).cwiseInverse().asDiagonal();
}

}  // namespace wavebalance::fem
