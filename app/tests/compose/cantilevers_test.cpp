// The example of two bodies in contact, reproduce/scenes/matrices/cantilevers.toml.
#include <gtest/gtest.h>

#include "support/cantilevers.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/scene/contacts.hpp"

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

TEST(CantileverScene, TouchesAndDoesNotPenetrateFurtherThanItsSpringsYield) {
  const Scene scene = load_scene(std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "cantilevers.toml");
  const Response response = weighted_residual_response(scene);
  ASSERT_TRUE(response.converged) << response.status;
  EXPECT_EQ(response.contacts.rows(), 30);
  EXPECT_GE((response.contacts.force.rowwise().maxCoeff().array() > 0.0).count(), 6);
  const double deepest = response.contacts.displacement.maxCoeff() - contacts_of(scene).at(0).gap;
  EXPECT_NEAR(deepest, response.contacts.force.maxCoeff() / scene.contact.pairs[0].number("stiffness"),
              1e-3 * deepest);
}

class CantileverVariant : public ::testing::TestWithParam<std::vector<std::string>> {};

// The cantilevers are symmetric about their middle: pairs of contacts reach their gaps together.
TEST_P(CantileverVariant, IsFoundByLoweringTheUpperOne) {
  const Response response = weighted_residual_response(
      load_scene(std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "cantilevers.toml", GetParam()));
  EXPECT_TRUE(response.converged) << response.status;
  EXPECT_EQ(response.strategy, "gap_continuation");
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, CantileverVariant,
    ::testing::Values(std::vector<std::string>{"forcing.amplitude=0.5", "forcing.frequency=95"},
                      std::vector<std::string>{"time.trial=bspline", "time.weight=bspline",
                                               "time.functions=64"}));

}  // namespace
