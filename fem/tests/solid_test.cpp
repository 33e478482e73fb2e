#include "wavebalance/fem/solid.hpp"

#include <Eigen/Geometry>

#include "dense_algebra.hpp"
#include "print.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::fem {
namespace {

using Stress = Eigen::Matrix<double, 6, 1>;
const SolidMaterial steel{210e9, 0.3, 7800.0};

class EverySolid : public testing::TestWithParam<SolidElement> {};
INSTANTIATE_TEST_SUITE_P(Solid, EverySolid,
                         testing::Values(SolidElement::hexahedron8, SolidElement::hexahedron20,
                                         SolidElement::hexahedron20_reduced),
                         case_name);

// Straight edges, no two faces parallel.
Eigen::Vector3d skewed(const Eigen::Vector3d& at) {
  return {1.3 * at[0] + 0.2 * at[1] + 0.3 * at[1] * at[2] + 0.05,
          0.9 * at[1] - 0.1 * at[2] + 0.2 * at[0] * at[2] - 0.1 * at[0] * at[1] * at[2],
          1.1 * at[2] + 0.15 * at[0] - 0.25 * at[0] * at[1]};
}

// Two cells per direction with the node between them pulled out of place; edges stay straight.
Eigen::Vector3d patch(const Eigen::Vector3d& at) {
  const double tent = (1.0 - (2.0 * at.array() - 1.0).abs()).prod();
  return skewed(at + tent * Eigen::Vector3d(0.11, -0.07, 0.13));
}

Eigen::Vector3d curved(const Eigen::Vector3d& at) {
  return patch(at) + 0.04 * Eigen::Vector3d(std::sin(5 * at[1]), std::cos(4 * at[2]), std::sin(6 * at[0]));
}

// The coordinates of one element, in the order of its nodes.
Eigen::Matrix3Xd coordinates_of(SolidElement element,
                                const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& mapping) {
  return structured_mesh(element, {1, 1, 1}, mapping).mesh.coordinates(0);
}

const Eigen::Matrix3d gradient =
    (Eigen::Matrix3d() << 1e-3, 2e-4, -3e-4, 4e-4, -2e-3, 5e-4, 6e-4, -7e-4, 8e-4).finished();

Stress hooke(const Eigen::Matrix3d& slope, const SolidMaterial& material) {
  const double shear = material.youngs_modulus / (2 * (1 + material.poissons_ratio));
  const double lame = 2 * shear * material.poissons_ratio / (1 - 2 * material.poissons_ratio);
  const Eigen::Matrix3d stress =
      lame * slope.trace() * Eigen::Matrix3d::Identity() + shear * (slope + slope.transpose());
  return (Stress() << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(0, 2))
      .finished();
}

// Displacements of a linear field on the boundary of a patch: the inner nodes must follow it.
void expect_patch_test(const StructuredMesh& block) {
  const auto boundary = block.nodes_where(
      [](const Eigen::Vector3d& at) { return (at.array() == 0.0 || at.array() == 1.0).any(); });
  const SolidModel free_model = hold_nodes(block.mesh, steel, {});
  const SolidModel held_model = hold_nodes(block.mesh, steel, boundary);
  const Eigen::SparseMatrix<double> stiffness = solid_matrices(free_model).stiffness;
  const Eigen::MatrixXd inner(solid_matrices(held_model).stiffness);
  ASSERT_GT(inner.rows(), 0);
  const Eigen::Matrix3Xd exact = gradient * block.mesh.nodes;
  Eigen::Matrix3Xd prescribed = Eigen::Matrix3Xd::Zero(3, exact.cols());
  prescribed(Eigen::all, boundary) = exact(Eigen::all, boundary);
  const Eigen::VectorXd load = -stiffness * prescribed.reshaped();
  const Eigen::Matrix3Xd found = prescribed + held_model.displacements(oracle::solve_positive_definite(
                                                  inner, load(held_model.dofs.free())));
  EXPECT_LE((found - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
  const Stress expected = hooke(gradient, steel);
  const auto stress = nodal_stress(held_model, found);
  EXPECT_LE((stress.colwise() - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
}

TEST_P(EverySolid, PassesThePatchTestWhenDistorted) {
  expect_patch_test(structured_mesh(GetParam(), {2, 2, 2}, patch));
}

TEST(Hexahedron20, PassesThePatchTestWithCurvedEdgesToo) {
  expect_patch_test(structured_mesh(SolidElement::hexahedron20, {2, 2, 2}, curved));
}

TEST_P(EverySolid, HasNoEnergyInRigidMotionsOnly) {
  const SolidMesh mesh = structured_mesh(GetParam(), {2, 2, 2}, skewed).mesh;
  const Eigen::MatrixXd stiffness(solid_matrices(hold_nodes(mesh, steel, {})).stiffness);
  const Eigen::VectorXd eigenvalues = oracle::symmetric_eigenvalues(stiffness);
  const double largest = eigenvalues.tail(1)[0];
  EXPECT_LE(eigenvalues.head(6).cwiseAbs().maxCoeff(), 512 * eps * largest);
  EXPECT_GT(eigenvalues[6], 1e-4 * largest);
  for (int mode = 0; mode < 6; ++mode) {
    Eigen::Matrix3Xd motion(3, mesh.nodes.cols());
    for (Eigen::Index node = 0; node < motion.cols(); ++node) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(mode % 3);
      motion.col(node) = mode < 3 ? axis : axis.cross(Eigen::Vector3d(mesh.nodes.col(node)));
    }
    const Eigen::VectorXd vector = motion.reshaped();
    EXPECT_LE((stiffness * vector).norm(), 512 * eps * largest * vector.norm()) << mode;
  }
}

TEST_P(EverySolid, HasSymmetricMatrices) {
  const Eigen::Matrix3Xd nodes = coordinates_of(GetParam(), skewed);
  const Eigen::MatrixXd stiffness = element_stiffness(GetParam(), nodes, steel);
  EXPECT_LE((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff(), 8 * eps * stiffness.norm());
  const Eigen::MatrixXd mass = element_mass(GetParam(), nodes, steel);
  EXPECT_LE((mass - mass.transpose()).cwiseAbs().maxCoeff(), 8 * eps * mass.norm());
  EXPECT_TRUE(oracle::is_positive_definite(mass));
}

// The volume of the image of the unit cube is the integral of the Jacobian of skewed, here by the midpoint
// rule on a fine grid (error of order 1/n^2).
TEST_P(EverySolid, HasDensityTimesVolumeAsMassInEveryDirection) {
  const int fine = 40;
  double volume = 0.0;
  for (int index = 0; index < fine * fine * fine; ++index) {
    const double x = (index % fine + 0.5) / fine, y = (index / fine % fine + 0.5) / fine,
                 z = (index / (fine * fine) + 0.5) / fine;
    Eigen::Matrix3d slope;
    slope << 1.3, 0.2 + 0.3 * z, 0.3 * y, 0.2 * z - 0.1 * y * z, 0.9 - 0.1 * x * z,
        -0.1 + 0.2 * x - 0.1 * x * y, 0.15 - 0.25 * y, -0.25 * x, 1.1;
    volume += slope.determinant() / (fine * fine * fine);
  }
  const SolidMesh mesh = structured_mesh(GetParam(), {2, 1, 2}, skewed).mesh;
  const Eigen::SparseMatrix<double> mass = solid_matrices(hold_nodes(mesh, steel, {})).mass;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd translation = Eigen::Vector3d::Unit(axis).replicate(mesh.nodes.cols(), 1);
    EXPECT_NEAR(translation.dot(mass * translation) / (steel.density * volume), 1.0, 1e-4) << axis;
  }
}

TEST_P(EverySolid, IsIndifferentToTheFrame) {
  const Eigen::Matrix3Xd nodes = coordinates_of(GetParam(), skewed);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3Xd moved = (turn * nodes).colwise() + Eigen::Vector3d(3, -2, 1);
  const Eigen::MatrixXd stiffness = element_stiffness(GetParam(), nodes, steel);
  Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(stiffness.rows(), stiffness.cols());
  for (Eigen::Index node = 0; node < nodes.cols(); ++node) turned.block<3, 3>(3 * node, 3 * node) = turn;
  const Eigen::MatrixXd expected = turned * stiffness * turned.transpose();
  EXPECT_LE((element_stiffness(GetParam(), moved, steel) - expected).norm(), 512 * eps * expected.norm());
}

TEST_P(EverySolid, HasTheStressOfHookesLawInConstantStrain) {
  const SolidMesh mesh = structured_mesh(GetParam(), {1, 1, 1}, skewed).mesh;
  const Stress expected = hooke(gradient, steel);
  const auto found = nodal_stress(hold_nodes(mesh, steel, {}), gradient * mesh.nodes);
  EXPECT_LE((found.colwise() - expected).colwise().norm().maxCoeff(), 1024 * eps * expected.norm());
}

// Pure bending of a brick: sigma_zz = E kappa x, which 8 nodes represent by their incompatible modes only.
TEST_P(EverySolid, HoldsPureBendingOfABrickExactly) {
  const SolidMesh mesh =
      structured_mesh(GetParam(), {1, 1, 1}, [](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        return at.array() - 0.5;
      }).mesh;
  const Eigen::Matrix3Xd& nodes = mesh.nodes;
  const double curvature = 1e-3, nu = steel.poissons_ratio;
  Eigen::Matrix3Xd moved(3, nodes.cols());
  for (Eigen::Index node = 0; node < moved.cols(); ++node) {
    const double x = nodes(0, node), y = nodes(1, node), z = nodes(2, node);
    moved.col(node) << -(z * z + nu * (x * x - y * y)) / 2, -nu * x * y, x * z;
  }
  moved *= curvature;
  const double scale = steel.youngs_modulus * curvature;
  const auto found = nodal_stress(hold_nodes(mesh, steel, {}), moved);
  const auto expected = Stress::Unit(2) * (scale * nodes.row(0));
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

TEST_P(EverySolid, RejectsAnElementTurnedInsideOut) {
  SolidMesh mesh = structured_mesh(GetParam(), {1, 1, 1}, skewed).mesh;
  mesh.nodes.row(0) *= -1;
  EXPECT_THROW(element_stiffness(mesh.element, mesh.coordinates(0), steel), std::invalid_argument);
  EXPECT_THROW(element_mass(mesh.element, mesh.coordinates(0), steel), std::invalid_argument);
  try {
    solid_matrices(hold_nodes(mesh, steel, {}));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("element 0"), std::string::npos) << error.what();
  }
}

TEST(SolidMesh, RejectsSizesAndNumbersThatDoNotFit) {
  SolidMesh mesh = structured_mesh(SolidElement::hexahedron20, {1, 1, 1}, skewed).mesh;
  EXPECT_THROW(element_stiffness(SolidElement::hexahedron8, mesh.nodes, steel), std::invalid_argument);
  EXPECT_THROW(hold_nodes(mesh, steel, {20}), std::invalid_argument);
  mesh.elements(3, 0) = 20;
  EXPECT_THROW(mesh.validate(), std::invalid_argument);
  mesh.elements(3, 0) = 0;
  mesh.nodes(1, 1) = std::nan("");
  EXPECT_THROW(mesh.validate(), std::invalid_argument);
  mesh.element = SolidElement::hexahedron8;
  EXPECT_THROW(mesh.validate(), std::invalid_argument);
  EXPECT_THROW(structured_mesh(SolidElement::hexahedron8, {1, 0, 1}, skewed), std::invalid_argument);
  EXPECT_THROW((SolidMaterial{1.0, 0.5, 1.0}.validate()), std::invalid_argument);
  EXPECT_THROW((SolidMaterial{-1.0, 0.3, 1.0}.validate()), std::invalid_argument);
  EXPECT_THROW((SolidMaterial{1.0, 0.3, 0.0}.validate()), std::invalid_argument);
}

TEST(Blade, HasItsContactNodesInPairsAlongTheTip) {
  const BladeOptions options;
  const Blade found = blade(options);
  EXPECT_EQ(found.model.dofs.count(), 3936);
  ASSERT_EQ(found.contact_nodes.size(), 24u);
  ASSERT_EQ(found.boundary_unknowns.size(), 72u);
  for (std::size_t i = 0; i < 24; ++i) {
    const Eigen::Vector3d at = found.model.mesh.nodes.col(found.contact_nodes[i]);
    EXPECT_DOUBLE_EQ(at[2], options.length);
    if (i >= 2) {
      EXPECT_GT(at[0], found.model.mesh.nodes(0, found.contact_nodes[i - 2]));
    }
    EXPECT_EQ(found.model.dofs.free()[static_cast<std::size_t>(found.contact_unknowns[i])],
              3 * found.contact_nodes[i] + 2);
  }
}

TEST(Blade, RejectsParametersThatMakeNoBlade) {
  const auto rejects = [](auto change) {
    BladeOptions options;
    change(options);
    EXPECT_THROW(blade(options), std::invalid_argument);
  };
  rejects([](BladeOptions& options) { options.chord[1] = 0.0; });
  rejects([](BladeOptions& options) { options.thickness_ratio[0] = -0.1; });
  rejects([](BladeOptions& options) { options.edge_thickness = 0.0; });
  rejects([](BladeOptions& options) { options.length = std::nan(""); });
  rejects([](BladeOptions& options) { options.span_elements = 0; });
  rejects([](BladeOptions& options) { options.angle_degrees[1] = INFINITY; });
  rejects([](BladeOptions& options) { options.material.poissons_ratio = 0.6; });
}

}  // namespace
}  // namespace wavebalance::fem
