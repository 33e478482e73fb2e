// Meshes of structures of matrices, whose nodes move with the rows that the dof map gives them.
#include "compose/moved_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

/// The chain along z: node 4 is clamped, and has no row.
class MeshOfAChain : public testing::Test {
 protected:
  MeshOfAChain() {
    write_chain(folder_);
    folder_.write("chain.dof", "1.3\n2.3\n3.3\n");
    folder_.write(
        "chain.inp",
        "*NODE\n4, 0, 0, 0\n1, 0, 0, 1\n2, 0, 0, 2\n3, 0, 0, 3\n*ELEMENT, TYPE=B31\n1, 4, 1\n2, 1, 2\n"
        "3, 2, 3\n");
  }
  Scene load(const std::string& mesh = "chain.inp", const std::vector<std::string>& overrides = {}) const {
    const std::string names = "contact_dofs = [2, 3]\ndof_map = \"chain.dof\"\nmesh = \"" + mesh + "\"";
    return parse_scene(with(chain_scene, "contact_dofs = [2, 3]", names),
                       (folder_.path() / "case.toml").string(), overrides);
  }
  std::string refusal(const std::string& mesh) const {
    return details_of_error([&](const std::string&) { load(mesh); }, "").allowed;
  }
  TemporaryFolder folder_;
};

TEST_F(MeshOfAChain, MovesWithItsRows) {
  const StructureModel model = make_model(load());
  ASSERT_NE(model.mesh, nullptr);
  const Eigen::VectorXd moved = model.mesh->displacements * Eigen::Vector3d(0.1, 0.2, 0.3);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(12);  // nodes 1 to 4, x, y and z of each
  expected[2] = 0.1;
  expected[5] = 0.2;
  expected[8] = 0.3;
  EXPECT_EQ(moved, expected);
}

TEST_F(MeshOfAChain, IsWrittenForParaViewBesideTheRows) {
  const Record record = analyse(load("chain.inp", {"analysis.motion_points=4"}));
  ASSERT_TRUE(record.converged);
  std::vector<std::string> names;
  for (const RecordFile& file : record.files) names.push_back(file.name);
  if (names.back() == "motion.body.js") names.pop_back();  // where the library that moves bodies is there
  EXPECT_EQ(names, (std::vector<std::string>{"motion.mtx", "motion_0000.vtu", "motion_0001.vtu",
                                             "motion_0002.vtu", "motion_0003.vtu", "motion.pvd"}));
  EXPECT_NE(record.files[1].contents.find("NumberOfPoints=\"4\" NumberOfCells=\"3\""), std::string::npos);
  EXPECT_EQ(load().analysis.motion_points, 32);
  EXPECT_EQ(parse_scene(chain_scene, (folder_.path() / "case.toml").string()).analysis.motion_points, 0);
}

TEST_F(MeshOfAChain, TakesTheMeanOfRowsOfOneName) {
  folder_.write("chain.dof", "1.3\n2.3\n2.3\n");
  const StructureModel model = make_model(load());
  const Eigen::VectorXd moved = model.mesh->displacements * Eigen::Vector3d(0.1, 0.2, 0.4);
  EXPECT_DOUBLE_EQ(moved[5], 0.3);
}

TEST_F(MeshOfAChain, IsRefusedWhereItDoesNotFit) {
  folder_.write("other.inp", "*NODE\n7, 0, 0, 0\n8, 0, 0, 1\n*ELEMENT, TYPE=B31\n1, 7, 8\n");
  EXPECT_NE(refusal("other.inp").find("has none of the nodes of structure.dof_map"), std::string::npos);
  folder_.write("empty.inp", "*HEADING\n");
  EXPECT_NE(refusal("empty.inp").find("there is no element"), std::string::npos);
  EXPECT_NE(refusal("missing.inp").find("missing.inp"), std::string::npos);
  const auto without_map = details_of_error(
      [&](const std::string& text) { parse_scene(text, (folder_.path() / "case.toml").string()); },
      with(chain_scene, "contact_dofs = [2, 3]", "contact_dofs = [2, 3]\nmesh = \"chain.inp\""));
  EXPECT_EQ(without_map.key, "structure.mesh");
  EXPECT_NE(without_map.allowed.find("structure.dof_map"), std::string::npos) << without_map.allowed;
}

TEST(MeshOfTheBracket, HasClampedNodesThatStayAndOthersThatMoveWithTheirRows) {
  const auto file = std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "bracket" / "bracket.toml";
  const StructureModel model =
      make_model(load_scene(file, std::vector<std::string>{"structure.mesh=bracket.inp"}));
  ASSERT_NE(model.mesh, nullptr);
  model.mesh->mesh.validate();
  // Each row is one node and direction: the sums of the columns are one, and no node moves twice.
  const Eigen::SparseMatrix<double>& moves = model.mesh->displacements;
  const Eigen::VectorXd rows = moves * Eigen::VectorXd::Ones(moves.cols());
  const Eigen::RowVectorXd columns = Eigen::RowVectorXd::Ones(moves.rows()) * moves;
  EXPECT_EQ(columns.minCoeff(), 1.0);
  EXPECT_EQ(columns.maxCoeff(), 1.0);
  EXPECT_EQ(rows.minCoeff(), 0.0);
  EXPECT_EQ(rows.maxCoeff(), 1.0);
}

}  // namespace
}  // namespace wavebalance::app
