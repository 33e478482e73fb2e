// Masses that are semidefinite, as reduced integration leaves them, and nodes whose names are those of
// several rows: shells and beams that CalculiX expands to solids.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "compose/load_places.hpp"
#include "compose/structure_facts.hpp"
#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;

/// The chain, of which the last two masses have one kinetic energy together, 0.5 x 2 kg (v2 + v3)^2.
class SemidefiniteChain : public testing::Test {
 protected:
  SemidefiniteChain() {
    write_chain(folder_);
    folder_.write("m.mtx",
                  "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 2\n2 2 2\n3 2 2\n3 3 2\n");
  }
  Scene load(const std::vector<std::string>& overrides) const {
    return parse_scene(with(chain_scene, "[2, 3]", "[3]"), (folder_.path() / "case.toml").string(),
                       overrides);
  }
  TemporaryFolder folder_;
};

TEST_F(SemidefiniteChain, IsSolvedByItsModesWithMass) {
  const Scene scene = load({"structure.kept_modes=1"});
  // 1 / omega^2 are the eigenvalues of 2e-6 [1 2; 2 9], the flexibility of the two motions with mass times 2
  // kg.
  const double inverse[] = {2e-6 * (5.0 + std::sqrt(20.0)), 2e-6 * (5.0 - std::sqrt(20.0))};
  const StructureFacts facts = structure_facts(scene, 2);
  for (int mode = 0; mode < 2; ++mode)
    EXPECT_NEAR(facts.frequencies_hz[mode], 1.0 / (2.0 * std::numbers::pi * std::sqrt(inverse[mode])), 1e-7);
  const Record record = analyse(scene);
  EXPECT_TRUE(record.converged) << record.status;
}

TEST_F(SemidefiniteChain, IsRefusedWithoutKeptModesWithItsCause) {
  const auto found = details_of_error([&](const std::string&) { load({}); }, "");
  EXPECT_EQ(found.key, "structure.mass");
  EXPECT_NE(found.allowed.find("reduced integration"), std::string::npos) << found.allowed;
  EXPECT_NE(found.allowed.find("Expected structure.kept_modes"), std::string::npos) << found.allowed;
}

TEST_F(SemidefiniteChain, SaysThatThereAreFewerModesWithMass) {
  try {
    make_model(load({"structure.kept_modes=2"}));
    ADD_FAILURE() << "a singular mass was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("structure.kept_modes = 2: the mass is semidefinite"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(SemidefiniteChain, OfAnIndefiniteMassIsRefused) {
  folder_.write("m.mtx",
                "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 2\n2 2 2\n3 2 2.1\n3 3 2\n");
  const auto found = details_of_error([&](const std::string&) { load({"structure.kept_modes=1"}); }, "");
  EXPECT_NE(found.allowed.find("not positive semidefinite"), std::string::npos) << found.allowed;
}

TEST(RepeatedNames, AreNumberedInTheOrderOfTheirRows) {
  const TemporaryFolder folder;
  write_chain(folder);
  folder.write("chain.dof", "2.3\n7.3\n2.3\n");
  const auto load = [&](const std::string& name) {
    const std::string text = with(with(chain_scene, "[2, 3]", "[\"" + name + "\"]"), "modal_damping",
                                  "dof_map = \"chain.dof\"\nmodal_damping");
    return parse_scene(text, (folder.path() / "case.toml").string());
  };
  const auto fault = [&](const std::string& name) {
    return details_of_error([&](const std::string& one) { load(one); }, name).allowed;
  };
  EXPECT_EQ(load("-node 2 z #2").structure.matrices.contact_dofs, (std::vector<int>{-3}));
  EXPECT_EQ(load("node 2 z #1").structure.matrices.contact_dofs, (std::vector<int>{1}));
  EXPECT_EQ(contact_names(load("-node 2 z #2")), (std::vector<std::string>{"-node 2 z #2"}));
  EXPECT_NE(fault("node 2 z").find("expected one of \"node 2 z #1\" (row 1), \"node 2 z #2\" (row 3)"),
            std::string::npos)
      << fault("node 2 z");
  EXPECT_NE(fault("node 2 z #3").find("there are 2 rows of that name"), std::string::npos);
  EXPECT_NE(fault("node 2 z #0").find("is no degree of freedom"), std::string::npos);
  EXPECT_NE(fault("node 2 z 2").find("is no degree of freedom"), std::string::npos);
}

// Cantilevers of CalculiX's elements: the frequencies that wavebalance finds in the matrices are those that
// CalculiX prints of the same mesh.
class CalculixElements : public testing::TestWithParam<std::string> {
 protected:
  std::string material() const { return "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.\n"; }
  /// A beam of 1 m, or a plate of 0.4 m x 0.2 m.
  std::string mesh(const std::string& type) const {
    if (type == "C3D20R") return block(type);
    return type[0] == 'B' ? beam(type) : plate(type);
  }
  /// 0.2 m x 20 mm x 20 mm of 4 x 2 x 2 elements of 20 nodes, held at one end.
  std::string block(const std::string& type) const {
    constexpr int along = 9, across = 5;  // half steps and ends
    const auto node = [](int i, int j, int k) { return (i * across + j) * across + k + 1; };
    std::ostringstream text;
    text << "*NODE, NSET=ALL\n";
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j)
        for (int k = 0; k < across; ++k)
          if (i % 2 + j % 2 + k % 2 <= 1)
            text << node(i, j, k) << ", " << 0.025 * i << ", " << 0.005 * j << ", " << 0.005 * k << "\n";
    constexpr int places[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                   {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                   {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
                                   {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
    text << "*ELEMENT, TYPE=" << type << ", ELSET=E\n";
    int element = 0;
    for (int i = 0; i + 2 < along; i += 2)
      for (int j = 0; j + 2 < across; j += 2)
        for (int k = 0; k + 2 < across; k += 2) {
          text << ++element;
          for (int n = 0; n < 20; ++n)
            text << (n == 10 ? ",\n" : ", ") << node(i + places[n][0], j + places[n][1], k + places[n][2]);
          text << "\n";
        }
    text << material() << "*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n*BOUNDARY\n";
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k)
        if (j % 2 + k % 2 <= 1) text << node(0, j, k) << ", 1, 3\n";
    return text.str();
  }
  std::string beam(const std::string& type) const {
    const int nodes_each = type == "B32" ? 2 : 1, elements = 6, nodes = nodes_each * elements + 1;
    std::ostringstream text;
    text << "*NODE, NSET=ALL\n";
    for (int i = 1; i <= nodes; ++i) text << i << ", " << double(i - 1) / (nodes - 1) << ", 0., 0.\n";
    text << "*ELEMENT, TYPE=" << type << ", ELSET=E\n";
    for (int e = 0; e < elements; ++e) {
      text << e + 1;
      for (int i = 0; i <= nodes_each; ++i) text << ", " << nodes_each * e + i + 1;
      text << "\n";
    }
    text << material() << "*BEAM SECTION, ELSET=E, MATERIAL=STEEL, SECTION=RECT\n0.02, 0.01\n0., 1., 0.\n"
         << "*BOUNDARY\n1, 1, 6\n";
    return text.str();
  }
  std::string plate(const std::string& type) const {
    const int each = type == "S4" ? 1 : 2, along = 4, across = 2, row = each * along + 1;
    const auto node = [&](int i, int j) { return j * row + i + 1; };
    std::ostringstream text;
    text << "*NODE, NSET=ALL\n";
    for (int j = 0; j <= each * across; ++j)
      for (int i = 0; i < row; ++i)
        if (each == 1 || i % 2 == 0 || j % 2 == 0)
          text << node(i, j) << ", " << 0.4 * i / (row - 1) << ", " << 0.2 * j / (each * across) << ", 0.\n";
    text << "*ELEMENT, TYPE=" << type << ", ELSET=E\n";
    for (int b = 0, e = 0; b < each * across; b += each)
      for (int a = 0; a < each * along; a += each) {
        text << ++e << ", " << node(a, b) << ", " << node(a + each, b) << ", " << node(a + each, b + each)
             << ", " << node(a, b + each);
        if (each == 2)
          text << ", " << node(a + 1, b) << ", " << node(a + 2, b + 1) << ", " << node(a + 1, b + 2) << ", "
               << node(a, b + 1);
        text << "\n";
      }
    text << material() << "*SHELL SECTION, ELSET=E, MATERIAL=STEEL\n0.004\n*BOUNDARY\n";
    for (int j = 0; j <= each * across; ++j) text << node(0, j) << ", 1, 6\n";
    return text.str();
  }
  void run(const std::string& job, const std::string& solver) const {
    folder_.write(job + ".inp", mesh(GetParam()) + "*STEP\n*FREQUENCY" + solver + "\n5\n*END STEP\n");
    const std::string command =
        "cd '" + folder_.path().string() + "' && ccx " + job + " > " + job + ".log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  /// The column "cycles/time" of the table of eigenvalues.
  std::vector<double> printed_frequencies(const std::string& job) const {
    std::ifstream file(folder_.path() / (job + ".dat"));
    std::vector<double> found;
    for (std::string line; std::getline(file, line) && found.size() < 5;) {
      std::istringstream words(line);
      double mode = 0, value = 0, angular = 0, cycles = 0;
      if (words >> mode >> value >> angular >> cycles && mode == double(found.size() + 1))
        found.push_back(cycles);
    }
    return found;
  }

  TemporaryFolder folder_;
};

TEST_P(CalculixElements, HaveTheFrequenciesThatCalculixPrintsAndAreSolved) {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0) GTEST_SKIP() << "CalculiX is not installed";
  run("matrices", ", SOLVER=MATRIXSTORAGE");
  run("modes", "");
  std::ifstream names(folder_.path() / "matrices.dof");
  int last_row = 0;
  for (std::string line; std::getline(names, line);) ++last_row;
  const std::string row = std::to_string(last_row);
  const Scene scene = parse_scene(
      "[structure]\ntype = \"matrices\"\nmass = \"matrices.mas\"\nstiffness = \"matrices.sti\"\n"
      "dof_map = \"matrices.dof\"\ncontact_dofs = [" +
          row +
          "]\nmodal_damping = 0.02\nkept_modes = 5\n"
          "[contact]\nlaw = \"linear\"\nstiffness = 1e4\ngap = 1e-3\n"
          "[forcing]\nload_dofs = [" +
          row +
          "]\namplitude = 1.0\nfrequency = 5.0\nweight = [0, 0, -9.81]\n"
          "[time]\ntrial = \"fourier\"\nweight = \"fourier\"\nfunctions = 31\n",
      (folder_.path() / "case.toml").string());
  const std::vector<double> printed = printed_frequencies("modes");
  ASSERT_EQ(printed.size(), 5u);
  const StructureFacts facts = structure_facts(scene);
  for (int mode = 0; mode < 5; ++mode)
    EXPECT_NEAR(facts.frequencies_hz[mode] / printed[std::size_t(mode)], 1.0, 1e-5)
        << GetParam() << " " << mode;
  const Record record = analyse(scene);
  EXPECT_TRUE(record.converged) << record.status;
  // The weight of the steel, without what the held nodes carry.
  const double volume = GetParam()[0] == 'B'   ? 1.0 * 0.02 * 0.01
                        : GetParam()[0] == 'S' ? 0.4 * 0.2 * 0.004
                                               : 0.2 * 0.02 * 0.02;
  const double weight = 9.81 * 7850.0 * volume;
  const auto files = structure_files(scene);
  const double found = -files->at_unknowns(files->rows_along(2)).dot(weight_of(scene.forcing, *files));
  EXPECT_LE(found, weight);
  EXPECT_GE(found, 0.85 * weight);
}

INSTANTIATE_TEST_SUITE_P(Types, CalculixElements, testing::Values("C3D20R", "S8R", "S4", "B31", "B32"),
                         [](const auto& type) { return type.param; });

}  // namespace
