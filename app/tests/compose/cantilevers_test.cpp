// The example of two bodies in contact, reproduce/scenes/matrices/cantilevers.toml.
#include <gtest/gtest.h>

#include "support/cantilevers.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace {

using namespace wavebalance::app;

TEST(CantileverScene, HasTheMatricesOfFemAndAPairForEveryTwoNodesThatFaceEachOther) {
  const auto folder = std::filesystem::path(WAVEBALANCE_SCENES) / "matrices";
  const Cantilevers cantilevers;
  for (const auto& [file, expected] :
       {std::pair{"cantilevers_mass.mtx", &cantilevers.matrices().mass},
        std::pair{"cantilevers_stiffness.mtx", &cantilevers.matrices().stiffness}}) {
    const Eigen::SparseMatrix<double> difference =
        wavebalance::fem::read_matrix_market(folder / file) - *expected;
    EXPECT_LT(difference.norm(), 1e-12 * expected->norm()) << file;
  }
  const Scene scene = load_scene(folder / "cantilevers.toml");
  ASSERT_EQ(cantilevers.facing().size(), 30u);
  ASSERT_EQ(scene.contact.pairs.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_EQ(scene.contact.pairs[i].dofs,
              (std::vector<int>{cantilevers.facing()[i].first + 1, cantilevers.facing()[i].second + 1}));
}

}  // namespace
