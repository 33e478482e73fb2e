#include <fstream>
#include <sstream>

#include "blade_of.hpp"
#include "hexahedron.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

// Figures of CalculiX 2.20 (Debian 2.20-1), rad/s as printed, seven digits; its input file is in tests/data.
namespace wavebalance::fem {
namespace {

constexpr double seven_digits = 5e-7;

BladeOptions coarse(SolidElement element) { return blade_of(element, 4, 1, 5); }

void expect_frequencies(const Eigen::SparseMatrix<double>& stiffness, const Eigen::SparseMatrix<double>& mass,
                        const std::vector<double>& published) {
  const Eigen::VectorXd omega = eigenmodes(stiffness, mass, 8).omega;
  for (int mode = 0; mode < 8; ++mode)
    EXPECT_NEAR(omega[mode] / published[static_cast<std::size_t>(mode)], 1.0, seven_digits) << mode;
}

void expect_frequencies(const BladeOptions& options, const std::vector<double>& published) {
  const Matrices matrices = solid_matrices(blade(options).model);
  expect_frequencies(matrices.stiffness, matrices.mass, published);
}

TEST(CalculixBlade, HasTheNodesOfThisModule) {
  const SolidMesh mesh = blade(coarse(SolidElement::hexahedron20)).model.mesh;
  std::ifstream file(FEM_TEST_DATA "/blade_4x1x5.inp");
  std::string line;
  while (std::getline(file, line) && line.rfind("*NODE", 0) != 0) continue;
  for (Eigen::Index node = 0; node < mesh.nodes.cols(); ++node) {
    ASSERT_TRUE(std::getline(file, line));
    std::istringstream words(line);
    int number = 0;
    Eigen::Vector3d at;
    char comma = 0;
    words >> number >> comma >> at[0] >> comma >> at[1] >> comma >> at[2];
    ASSERT_EQ(number, node + 1);
    EXPECT_LE((at - mesh.nodes.col(node)).norm(), 1e-12);
  }
}

TEST(CalculixBlade, HasTheSameFrequenciesWithC3D20) {
  expect_frequencies(coarse(SolidElement::hexahedron20),
                     {3634.510, 10581.65, 14384.84, 24422.99, 30250.62, 33838.82, 36992.37, 43622.52});
}

// CalculiX integrates the mass of C3D20R at 8 points, this module at 27: with its mass the stiffness is the
// same.
TEST(CalculixBlade, HasTheSameFrequenciesWithC3D20RAndItsMass) {
  const SolidModel model = blade(coarse(SolidElement::hexahedron20_reduced)).model;
  const Eigen::SparseMatrix<double> mass = model.assembly().matrix([&](int index) {
    const auto samples =
        detail::sample(model.mesh.element, model.mesh.coordinates(index), detail::gauss_rule(2));
    const Eigen::MatrixXd scalar = samples.values * samples.volumes.asDiagonal() * samples.values.transpose();
    return detail::expand_by_block(model.material.density * scalar, Eigen::Matrix3d::Identity());
  });
  expect_frequencies(solid_matrices(model).stiffness, mass,
                     {3611.551, 10528.10, 14046.91, 24052.47, 29536.79, 33428.21, 34772.34, 41560.36});
}

TEST(CalculixBlade, HasTheSameFrequenciesWithAllElements) {
  expect_frequencies({}, {3581.197, 10445.14, 13861.67, 23757.72, 29251.40, 33252.88, 34020.80, 40522.79});
}

}  // namespace
}  // namespace wavebalance::fem
