// The example of matrices from CalculiX, reproduce/scenes/matrices/bracket.
#include <gtest/gtest.h>

#include <sstream>

#include "support/bracket.hpp"
#include "support/command.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/fem/dof_map.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/fem/matrix_file.hpp"

namespace {

using namespace wavebalance::app;
namespace fem = wavebalance::fem;
using Sparse = Eigen::SparseMatrix<double>;

std::filesystem::path bracket_file(const std::string& extension) {
  return std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "bracket" / ("bracket" + extension);
}

constexpr double fourteen_digits = 1e-12, seven_digits = 5e-7;
constexpr double twelve_digits_of_nodes = 2e-11;  // over the thickness of 4 mm

// Angular frequencies that CalculiX 2.20 prints to bracket.dat without SOLVER=MATRIXSTORAGE.
const std::vector<double> printed = {1209.001, 2116.397, 4139.416, 12790.14,
                                     16661.76, 26761.51, 34920.78, 52844.25};

TEST(BracketScene, HasTheMatricesOfFemInTheRowsThatItsDofMapNames) {
  const Bracket bracket;
  const fem::DofMap map = fem::read_dof_map(bracket_file(".dof"));
  const fem::Matrices matrices = fem::solid_matrices(bracket.model());
  ASSERT_EQ(map.rows(), matrices.stiffness.rows());
  std::vector<Eigen::Triplet<double>> ones;
  for (Eigen::Index node = 0; node < bracket.model().mesh.nodes.cols(); ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const int unknown = bracket.model().dofs.unknown(3 * static_cast<int>(node) + axis);
      const int row = map.row({static_cast<int>(node) + 1, axis + 1});
      ASSERT_EQ(row < 0, unknown < 0) << "node " << node + 1;
      if (row >= 0) ones.emplace_back(row, unknown, 1.0);
    }
  Sparse permutation(map.rows(), map.rows());
  permutation.setFromTriplets(ones.begin(), ones.end());
  for (const auto& [extension, expected] :
       {std::pair{".sti", &matrices.stiffness}, std::pair{".mas", &matrices.mass}}) {
    const Sparse permuted = permutation * *expected * permutation.transpose();
    const Sparse difference = fem::read_matrix(bracket_file(extension)) - permuted;
    EXPECT_LT(difference.norm(), twelve_digits_of_nodes * permuted.norm()) << extension;
  }
}

TEST(BracketScene, HasTheNaturalFrequenciesThatCalculixPrints) {
  const auto modes =
      fem::eigenmodes(fem::read_matrix(bracket_file(".sti")), fem::read_matrix(bracket_file(".mas")), 8);
  for (std::size_t mode = 0; mode < printed.size(); ++mode)
    EXPECT_NEAR(modes.omega[static_cast<Eigen::Index>(mode)] / printed[mode], 1.0, seven_digits) << mode;
}

/// Runs CalculiX on an input file in a folder of its own.
class Calculix : public testing::Test {
 protected:
  void SetUp() override {
    if (in_folder("command -v ccx").exit_code != 0) GTEST_SKIP() << "there is no ccx (Debian: calculix-ccx)";
  }
  Outcome in_folder(const std::string& command) const {
    return Command(folder_, {"-c", "cd '" + folder_.path().string() + "' && " + command}, "sh").wait();
  }
  TemporaryFolder folder_;
};

TEST_F(Calculix, WritesTheFilesOfTheBracketAgain) {
  folder_.write("bracket.inp", read_file(bracket_file(".inp")));
  ASSERT_EQ(in_folder("OMP_NUM_THREADS=1 ccx bracket").exit_code, 0);
  EXPECT_EQ(read_file(folder_ / "bracket.dof"), read_file(bracket_file(".dof")));
  for (const char* extension : {".sti", ".mas"}) {
    const Sparse kept = fem::read_matrix(bracket_file(extension));
    const Sparse difference = fem::read_matrix(folder_ / (std::string("bracket") + extension)) - kept;
    EXPECT_LT(difference.norm(), fourteen_digits * kept.norm()) << extension;
  }
}

TEST_F(Calculix, PrintsTheNaturalFrequenciesOfTheBracket) {
  std::string input = read_file(bracket_file(".inp"));
  const std::string storage = ", SOLVER=MATRIXSTORAGE";
  input.erase(input.rfind(storage), storage.size());
  folder_.write("bracket.inp", input);
  ASSERT_EQ(in_folder("OMP_NUM_THREADS=1 ccx bracket").exit_code, 0);
  std::istringstream output(read_file(folder_ / "bracket.dat"));
  std::vector<double> found;
  for (std::string line; std::getline(output, line) && found.size() < printed.size();) {
    std::istringstream words(line);
    std::size_t mode = 0;
    double square = 0.0, omega = 0.0;
    if (words >> mode >> square >> omega && mode == found.size() + 1) found.push_back(omega);
  }
  ASSERT_EQ(found.size(), printed.size());
  for (std::size_t mode = 0; mode < printed.size(); ++mode)
    EXPECT_NEAR(found[mode] / printed[mode], 1.0, seven_digits) << mode;
}

TEST(BracketScene, MeetsItsStopWithTheCornersThatItNames) {
  const Scene scene = load_scene(bracket_file(".toml"));
  const Bracket bracket;
  const fem::DofMap map = fem::read_dof_map(bracket_file(".dof"));
  std::vector<int> lower, upper;
  for (const int node : bracket.corners_of_end(0.0)) lower.push_back(-map.row({node + 1, 3}) - 1);
  for (const int node : bracket.corners_of_end(1.0)) upper.push_back(map.row({node + 1, 3}) + 1);
  EXPECT_EQ(scene.structure.matrices.contact_dofs, lower);
  EXPECT_EQ(scene.forcing.load_dofs, upper);
  const Response response = weighted_residual_response(scene);
  ASSERT_TRUE(response.converged) << response.status;
  EXPECT_GT(response.contacts.force.maxCoeff(), 1.0);
  const double deepest = response.contacts.displacement.maxCoeff() - scene.contact.gap;
  EXPECT_NEAR(deepest, response.contacts.force.maxCoeff() / scene.contact.number("stiffness"),
              1e-3 * deepest);
}

TEST(BracketScene, IsDescribedByItsFrequenciesAndByCompliancesAtItsNodes) {
  const std::string text = describe_scene(load_scene(bracket_file(".toml")));
  for (const char* part : {"modes      192.42, 336.84, 658.81, 2035.6, 2651.8 Hz, damping ratios 0.01 each",
                           "compliance 2.4128e-05 m/N at -node 73 z; 2.4128e-05 m/N at -node 75 z"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

}  // namespace
