#include "beam.hpp"
#include "blade_of.hpp"
#include "dense_algebra.hpp"
#include "print.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/centrifugal.hpp"
#include "wavebalance/fem/craig_bampton.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem {
namespace {

double lowest(const SolidModel& model, int mode = 0) {
  const Matrices matrices = solid_matrices(model);
  return eigenmodes(matrices.stiffness, matrices.mass, mode + 1, {.tolerance = 1e-10}).omega[mode];
}

SolidModel clamped(const Beam& beam, SolidElement element, const std::array<int, 3>& cells) {
  StructuredMesh block = beam.block(element, cells);
  const std::vector<int> held = root(block);
  return hold_nodes(std::move(block.mesh), beam.material, held);
}

class EveryBeam : public testing::TestWithParam<SolidElement> {};
INSTANTIATE_TEST_SUITE_P(Solid, EveryBeam,
                         testing::Values(SolidElement::hexahedron8, SolidElement::hexahedron20,
                                         SolidElement::hexahedron20_reduced),
                         case_name);

// Slenderness 50: shear and rotatory inertia lower the frequency by 0.1 %.
TEST_P(EveryBeam, HasTheFrequencyOfEulerAndBernoulliWhenSlender) {
  const Beam beam{0.03, 0.02, 1.0};
  EXPECT_NEAR(lowest(clamped(beam, GetParam(), {2, 2, 20})) / beam.euler_bernoulli_omega(), 1.0, 2e-3);
}

// Slenderness 5: shear is 3 % of the deflection. The tip section moves by one along y, all else is free.
TEST_P(EveryBeam, HasTheTipStiffnessOfTimoshenko) {
  const Beam beam{0.1, 0.2, 1.0};
  StructuredMesh block = beam.block(GetParam(), {2, 2, 10});
  const std::vector<int> held = root(block);
  const std::vector<int> tip = block.nodes_where([](const Eigen::Vector3d& at) { return at[2] == 1.0; });
  const SolidModel model = hold_nodes(std::move(block.mesh), beam.material, held);
  std::vector<int> boundary;
  for (int node : tip) boundary.push_back(model.dofs.unknown(3 * node + 1));
  const CraigBampton statics = craig_bampton(solid_matrices(model), boundary, {.modes = 0, .solver = {}});
  EXPECT_NEAR(statics.stiffness.sum() * beam.timoshenko_deflection(), 1.0, 1e-2);
}

// The unit cube sliding on all its faces: the three lowest modes are transverse waves with wave numbers
// (pi, pi, 0) and its permutations, omega^2 = 2 pi^2 mu/rho. The cells are bent, and more so within the cube.
double relative_error(SolidElement element, int cells) {
  const StructuredMesh block =
      structured_mesh(element, {cells, cells, cells}, [](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        const double bump = (at.array() * (1.0 - at.array())).prod();
        return at + bump * Eigen::Vector3d(2.0, -1.0, 1.5);
      });
  std::vector<int> held;
  for (int node = 0; node < block.parameters.cols(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      if (block.parameters(axis, node) == 0.0 || block.parameters(axis, node) == 1.0)
        held.push_back(3 * node + axis);
  const SolidMaterial material{1.0, 0.3, 1.0};
  const SolidModel model{block.mesh, material, FreeDofs(3 * static_cast<int>(block.parameters.cols()), held)};
  const Matrices matrices = solid_matrices(model);
  const double exact = std::numbers::pi * std::sqrt(1.0 / 1.3);
  return eigenmodes(matrices.stiffness, matrices.mass, 3, {.tolerance = 1e-10}).omega.mean() / exact - 1.0;
}

double observed_order(SolidElement element, int cells) {
  return std::log2(relative_error(element, cells) / relative_error(element, 2 * cells));
}

TEST(SolidFrequencies, ConvergeWithOrderTwoWithEightNodes) {
  EXPECT_NEAR(observed_order(SolidElement::hexahedron8, 5), 2.0, 0.1);
}

TEST(SolidFrequencies, ConvergeWithOrderFourWithTwentyNodes) {
  EXPECT_NEAR(observed_order(SolidElement::hexahedron20, 3), 4.0, 0.3);
}

// Starts from a far smaller error, which falls faster until it has the same slope.
TEST(SolidFrequencies, ConvergeWithAtLeastOrderFourWithTwentyNodesAndReducedIntegration) {
  EXPECT_GT(observed_order(SolidElement::hexahedron20_reduced, 3), 3.7);
  EXPECT_LT(std::abs(relative_error(SolidElement::hexahedron20_reduced, 6)),
            std::abs(relative_error(SolidElement::hexahedron20, 6)));
}

double first_of_blade(SolidElement element, int chord, int thickness, int span) {
  return lowest(blade(blade_of(element, chord, thickness, span)).model);
}

// Plain trilinear hexahedra are 35 % too stiff here.
TEST(ThinTwistedBlade, DoesNotLock) {
  const double fine = first_of_blade(SolidElement::hexahedron20, 16, 2, 24);
  EXPECT_NEAR(first_of_blade(SolidElement::hexahedron20, 6, 1, 8) / fine, 1.0, 1e-2);
  EXPECT_NEAR(first_of_blade(SolidElement::hexahedron20_reduced, 6, 1, 8) / fine, 1.0, 1e-2);
  EXPECT_NEAR(first_of_blade(SolidElement::hexahedron8, 11, 1, 16) / fine, 1.0, 2e-2);
}

// Lowest nondimensional flapping frequency of a uniform rotating cantilever without hub at speed
// Omega sqrt(rho A L^4/(E I)): Ritz on x^2 .. x^8 for the bending and the tension (1 - x^2)/2 speed^2.
double ritz_flapping_frequency(double speed) {
  constexpr int terms = 7;
  Eigen::MatrixXd stiffness(terms, terms), mass(terms, terms);
  for (int i = 2; i < terms + 2; ++i)
    for (int j = 2; j < terms + 2; ++j) {
      const double bending = i * (i - 1.0) * j * (j - 1.0) / (i + j - 3.0);
      const double tension = 0.5 * speed * speed * i * j * (1.0 / (i + j - 1.0) - 1.0 / (i + j + 1.0));
      stiffness(i - 2, j - 2) = bending + tension;
      mass(i - 2, j - 2) = 1.0 / (i + j + 1.0);
    }
  return std::sqrt(oracle::generalized_eigen(stiffness, mass).values[0]);
}

// Speeds 0, 3, 6 [WSTW82]. Lagging (in the plane of rotation) is softer by Omega^2.
TEST(RotatingBeam, StiffensAsTheEulerBernoulliBeam) {
  const Beam beam{0.01, 0.01, 1.0};
  const SolidModel model = clamped(beam, SolidElement::hexahedron20, {1, 1, 24});
  const Matrices matrices = solid_matrices(model);
  const CentrifugalStiffness turning = centrifugal_stiffness(model, matrices.stiffness, {});
  const double unit = beam.euler_bernoulli_omega() / 3.516015;
  const double speeds[] = {0.0, 3.0, 6.0}, published[] = {3.5160, 4.7973, 7.3604};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(ritz_flapping_frequency(speeds[i]), published[i], 6e-5);
    const Eigen::VectorXd omega = eigenmodes(turning.stiffness(matrices.stiffness, speeds[i] * unit),
                                             matrices.mass, 2, {.tolerance = 1e-10})
                                      .omega /
                                  unit;
    EXPECT_NEAR(omega[1] / published[i], 1.0, 3e-3) << speeds[i];
    EXPECT_NEAR(omega[1] * omega[1] - omega[0] * omega[0], speeds[i] * speeds[i], 1e-2) << speeds[i];
  }
}

}  // namespace
}  // namespace wavebalance::fem
