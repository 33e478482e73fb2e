#include <rapidcheck/gtest.h>
#include <Eigen/Geometry>
#include <sstream>

#include "random_values.hpp"
#include "testing.hpp"
#include "wavebalance/fem/matrix_market.hpp"
#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {
namespace {

SolidElement any_element() {
  return *rc::gen::element(SolidElement::hexahedron8, SolidElement::hexahedron20,
                           SolidElement::hexahedron20_reduced);
}

SolidMaterial any_material() {
  return {std::pow(10.0, any_between(-3, 12)), any_between(-0.5, 0.45), std::pow(10.0, any_between(-3, 5))};
}

// A box of any size and aspect up to 10 with a shear and corners off by up to a tenth; straight edges.
Eigen::Matrix3Xd any_coordinates(SolidElement element) {
  const double scale = std::pow(10.0, any_between(-3, 3));
  const Eigen::Vector3d sides(1.0, any_between(0.1, 1), any_between(0.1, 1));
  Eigen::Matrix<double, 3, 4> bend;  // of yz, xz, xy, xyz
  for (double& entry : bend.reshaped()) entry = any_between(-0.1, 0.1);
  return structured_mesh(element, {1, 1, 1},
                         [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
                           const Eigen::Vector4d products(at[1] * at[2], at[0] * at[2], at[0] * at[1],
                                                          at.prod());
                           return scale * sides.cwiseProduct(at + bend * products);
                         })
      .mesh.coordinates(0);
}

RC_GTEST_PROP(SolidProperty, OnlyRigidMotionsCostNoEnergy, ()) {
  const SolidElement element = any_element();
  const Eigen::Matrix3Xd nodes = any_coordinates(element);
  const Eigen::MatrixXd stiffness = element_stiffness(element, nodes, any_material());
  for (int mode = 0; mode < 6; ++mode) {
    Eigen::Matrix3Xd motion(3, nodes.cols());
    for (Eigen::Index node = 0; node < nodes.cols(); ++node) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(mode % 3);
      motion.col(node) = mode < 3 ? axis : axis.cross(Eigen::Vector3d(nodes.col(node)));
    }
    const Eigen::VectorXd vector = motion.reshaped();
    RC_ASSERT((stiffness * vector).norm() <= 1e-12 * stiffness.norm() * vector.norm());
  }
  const Eigen::VectorXd any = Eigen::VectorXd::Random(stiffness.rows());
  RC_ASSERT(any.dot(stiffness * any) > 0.0);
}

// Energy of a constant strain: half of stress times strain times volume, the volume being mass over density.
RC_GTEST_PROP(SolidProperty, ConstantStrainHasTheEnergyOfItsStress, ()) {
  const SolidElement element = any_element();
  const SolidMaterial material = any_material();
  const Eigen::Matrix3Xd nodes = any_coordinates(element);
  Eigen::Matrix3d slope;
  for (double& entry : slope.reshaped()) entry = any_between(-1, 1);
  const Eigen::Matrix3Xd moved = slope * nodes;
  const Eigen::VectorXd vector = moved.reshaped();
  const Eigen::VectorXd shift = Eigen::Vector3d::UnitX().replicate(nodes.cols(), 1);
  const double volume = shift.dot(element_mass(element, nodes, material) * shift) / material.density;
  const int count = static_cast<int>(nodes.cols());
  const SolidMesh mesh{element, nodes, Eigen::VectorXi::LinSpaced(count, 0, count - 1)};
  const Eigen::VectorXd stress = nodal_stress(hold_nodes(mesh, material, {}), moved).col(0);
  Eigen::Matrix<double, 6, 1> strain;
  strain << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0), slope(1, 2) + slope(2, 1),
      slope(0, 2) + slope(2, 0);
  const double energy = vector.dot(element_stiffness(element, nodes, material) * vector);
  RC_ASSERT(std::abs(energy - volume * stress.dot(strain)) <= 1e-10 * volume * stress.norm() * slope.norm());
}

RC_GTEST_PROP(MatrixMarketProperty, GivesBackAnySparseMatrix, ()) {
  const int rows = *rc::gen::inRange(1, 12), columns = *rc::gen::inRange(1, 12);
  Eigen::SparseMatrix<double> matrix(rows, columns);
  for (int i = *rc::gen::inRange(0, 30); i > 0; --i)
    matrix.coeffRef(*rc::gen::inRange(0, rows), *rc::gen::inRange(0, columns)) =
        any_between(-1, 1) * std::pow(10.0, any_between(-300, 300));
  std::istringstream file(matrix_market_text(matrix));
  RC_ASSERT(Eigen::MatrixXd(read_matrix_market(file, "any")) == Eigen::MatrixXd(matrix));
}

}  // namespace
}  // namespace wavebalance::fem
