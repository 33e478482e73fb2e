#include "wavebalance/fem/centrifugal.hpp"

#include <Eigen/Geometry>

#include "beam.hpp"
#include "print.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem {
namespace {

const Beam short_beam{0.1, 0.2, 1.0};

SolidModel clamped(SolidElement element) {
  StructuredMesh block = short_beam.block(element, {2, 2, 6});
  const std::vector<int> held = root(block);
  return hold_nodes(std::move(block.mesh), short_beam.material, held);
}

class EveryRotor : public testing::TestWithParam<SolidElement> {};
INSTANTIATE_TEST_SUITE_P(Solid, EveryRotor,
                         testing::Values(SolidElement::hexahedron8, SolidElement::hexahedron20), case_name);

// A bar about an axis at its root pulls itself out by rho L^3/(3 E), at radius R by rho R L^2/(2 E) more;
// without lateral contraction that is exact. Six cells carry the parabolic stress to 1/(2 6^2) at most.
TEST_P(EveryRotor, StretchesAsABarUnderItsCentrifugalLoad) {
  const SolidModel model = clamped(GetParam());
  const RotationAxis axis{{0, 1, 0}, {0, 0, -0.5}};
  const CentrifugalStiffness turning = centrifugal_stiffness(model, solid_matrices(model).stiffness, axis);
  const Eigen::Matrix3Xd moved = model.displacements(turning.displacement);
  const double expected =
      short_beam.material.density / short_beam.material.youngs_modulus * (1.0 / 3 + 0.5 / 2);
  double tip = 0.0;
  for (Eigen::Index node = 0; node < moved.cols(); ++node) tip = std::max(tip, moved(2, node));
  EXPECT_NEAR(tip / expected, 1.0, 1e-2);
}

// In a translation across the axis softening holds the whole mass of the free nodes, along it none.
TEST_P(EveryRotor, SoftensAcrossTheAxisOnly) {
  const SolidModel model = clamped(GetParam());
  const Matrices matrices = solid_matrices(model);
  const CentrifugalStiffness turning =
      centrifugal_stiffness(model, matrices.stiffness, {{0, 0, 3}, {0, 0, 0}});
  for (int direction = 0; direction < 3; ++direction) {
    const Eigen::VectorXd motion = Eigen::Vector3d::Unit(direction).replicate(model.dofs.count() / 3, 1);
    const double mass = motion.dot(matrices.mass * motion);
    EXPECT_NEAR(motion.dot(turning.softening * motion), direction < 2 ? mass : 0.0, 1e-12 * mass);
  }
}

// K_g acts on gradients: the same in all directions, nothing in a translation of all nodes.
TEST_P(EveryRotor, HasASymmetricGeometricStiffnessThatIsTheSameInAllDirections) {
  const SolidModel model = clamped(GetParam());
  const Eigen::MatrixXd geometric(
      centrifugal_stiffness(model, solid_matrices(model).stiffness, {}).geometric);
  EXPECT_LE((geometric - geometric.transpose()).norm(), 1e-14 * geometric.norm());
  const Eigen::Index nodes = geometric.rows() / 3;
  const auto block = [&](int a, int b) -> Eigen::MatrixXd {
    return geometric(Eigen::seqN(a, nodes, 3), Eigen::seqN(b, nodes, 3));
  };
  EXPECT_EQ(block(0, 0), block(1, 1));
  EXPECT_EQ(block(0, 0), block(2, 2));
  EXPECT_EQ(block(0, 1).norm(), 0.0);
}

// Turned with its axis, so that every component of stress occurs: the same matrix, node by node.
TEST_P(EveryRotor, HasAGeometricStiffnessThatIsIndifferentToTheFrame) {
  const SolidModel model = clamped(GetParam());
  SolidModel turned = model;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(3, -2, 1), direction(0.2, 1, 0.1), point(0.3, 0, -0.5);
  turned.mesh.nodes = (turn * model.mesh.nodes).colwise() + shift;
  const Eigen::MatrixXd expected(
      centrifugal_stiffness(model, solid_matrices(model).stiffness, {direction, point}).geometric);
  const Eigen::MatrixXd found(centrifugal_stiffness(turned, solid_matrices(turned).stiffness,
                                                    {turn * direction, turn * point + shift})
                                  .geometric);
  EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm());
}

TEST(RotatingBlade, HasHigherFrequenciesTheFasterItTurns) {
  const Blade still = blade();
  const Matrices matrices = solid_matrices(still.model);
  const CentrifugalStiffness turning =
      centrifugal_stiffness(still.model, matrices.stiffness, {{1, 0, 0}, {0, 0, -0.2}});
  Eigen::VectorXd previous = eigenmodes(matrices.stiffness, matrices.mass, 3, {.tolerance = 1e-8}).omega;
  for (double speed : {500.0, 1000.0}) {
    const Eigen::VectorXd omega =
        eigenmodes(turning.stiffness(matrices.stiffness, speed), matrices.mass, 3, {.tolerance = 1e-8}).omega;
    EXPECT_TRUE((omega.array() > previous.array()).all()) << omega.transpose() << "\n"
                                                          << previous.transpose();
    previous = omega;
  }
}

TEST(CentrifugalStiffness, RejectsWhatDoesNotFit) {
  const SolidModel model = clamped(SolidElement::hexahedron8);
  const Matrices matrices = solid_matrices(model);
  const Eigen::SparseMatrix<double> small(3, 3);
  EXPECT_THROW(centrifugal_stiffness(model, small, {}), std::invalid_argument);
  EXPECT_THROW(centrifugal_stiffness(model, matrices.stiffness, {{0, 0, 0}, {0, 0, 0}}),
               std::invalid_argument);
  EXPECT_THROW(centrifugal_stiffness(model, matrices.stiffness, {{0, 0, 1}, {0, NAN, 0}}),
               std::invalid_argument);
  const Eigen::SparseMatrix<double> negative = -matrices.stiffness;
  EXPECT_THROW(centrifugal_stiffness(model, negative, {}), std::domain_error);
  const CentrifugalStiffness turning = centrifugal_stiffness(model, matrices.stiffness, {});
  EXPECT_THROW(turning.stiffness(small, 1.0), std::invalid_argument);
  EXPECT_THROW(turning.stiffness(matrices.stiffness, INFINITY), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::fem
