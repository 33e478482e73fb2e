// The example of matrices from CalculiX, reproduce/scenes/matrices/bracket.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/bracket.hpp"
#include "wavebalance/fem/dof_map.hpp"
#include "wavebalance/fem/matrix_file.hpp"

namespace {

namespace fem = wavebalance::fem;
using Sparse = Eigen::SparseMatrix<double>;

std::filesystem::path bracket_file(const std::string& extension) {
  return std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "bracket" / ("bracket" + extension);
}

constexpr double twelve_digits_of_nodes = 2e-11;  // over the thickness of 4 mm

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

}  // namespace
