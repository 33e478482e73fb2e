// Names of degrees of freedom in scenes of matrices, files of other formats than Matrix Market, and what
// `check` says of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compose/structure_facts.hpp"
#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace {

using namespace wavebalance::app;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

const std::string named_scene =
    replaced(replaced(replaced(chain_scene, "[2, 3] ", "[\"node 20 x\", \"-node 4 ry\"]"), "load_dofs = [3]",
                      "load_dofs = [\"node 4 ry\"]"),
             "modal_damping = 0.01 ", "modal_damping = 0.01\ndof_map = \"chain.dof\" ");

class NamedChain : public testing::Test {
 protected:
  NamedChain() {
    write_chain(folder_);
    folder_.write("chain.dof", "7.1\n20.1\n4.5\n");
  }
  Scene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_scene(text, (folder_ / "case.toml").string(), overrides);
  }
  SceneError::Details fault(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return details_of_error([&](const std::string& one) { load(one, overrides); }, text);
  }
  void expect_fault(const std::string& text, int line, const std::string& key,
                    const std::string& part) const {
    const auto details = fault(text);
    EXPECT_EQ(details.line, line) << details.allowed;
    EXPECT_EQ(details.key, key) << details.allowed;
    EXPECT_NE(details.allowed.find(part), std::string::npos) << details.allowed << "\nlacks: " << part;
  }
  TemporaryFolder folder_;
};

TEST_F(NamedChain, HasTheRowsThatTheMapGivesToItsNames) {
  const Scene scene = load(named_scene);
  EXPECT_EQ(scene.structure.matrices.contact_dofs, (std::vector<int>{2, -3}));
  EXPECT_EQ(scene.forcing.load_dofs, (std::vector<int>{3}));
  EXPECT_EQ(load(named_scene, {R"(structure.contact_dofs=[1, "node 20 1", "-node 4 ROTY"])"})
                .structure.matrices.contact_dofs,
            (std::vector<int>{1, 2, -3}));
  folder_.write("chain.csv", "row,node,direction\n3,4,ry\n1,7,x\n2,20,x\n");
  EXPECT_EQ(load(named_scene, {"structure.dof_map=chain.csv"}).structure.matrices.contact_dofs,
            (std::vector<int>{2, -3}));
}

TEST_F(NamedChain, NamesDofsOfPairsAndReadsBackAsWritten) {
  const std::string pairs = replaced(replaced(named_scene, "contact_dofs", "# "), "[forcing]",
                                     "[[contact.pairs]]\ndofs = [\"node 20 x\", \"node 7 x\"]\n[forcing]");
  const Scene scene = load(pairs);
  ASSERT_EQ(scene.contact.pairs.size(), 1u);
  EXPECT_EQ(scene.contact.pairs[0].dofs, (std::vector<int>{2, 1}));
  EXPECT_EQ(parse_scene(write_scene(scene), "written.toml"), scene);
  expect_fault(replaced(pairs, "\"node 7 x\"", "\"-node 7 x\""), 13, "contact.pairs[1].dofs",
               "expected no sign here; coefficients has the signs");
}

TEST_F(NamedChain, FaultsOfNamesSayWhereAndWhatIsAllowed) {
  const auto contact = [&](const std::string& name) { return replaced(named_scene, "\"node 20 x\"", name); };
  expect_fault(contact("\"nod 20 x\""), 5, "structure.contact_dofs", "\"nod 20 x\" is no degree of freedom");
  expect_fault(contact("\"node 20 w\""), 5, "structure.contact_dofs", "a direction of x, y, z, rx, ry, rz");
  expect_fault(contact("\"node 20 x 3\""), 5, "structure.contact_dofs", "is no degree of freedom");
  expect_fault(contact("\"node 20 y\""), 5, "structure.contact_dofs", "expected one of x");
  expect_fault(contact("\"node 21 x\""), 5, "structure.contact_dofs",
               "node 21 is not in " + (folder_ / "chain.dof").string());
  expect_fault(contact("2.5"), 5, "structure.contact_dofs", "expected a list of integers or texts");
  expect_fault(contact("\"node 4 ry\""), 5, "structure.contact_dofs", "degree of freedom 3 is there twice");
  expect_fault(replaced(named_scene, "dof_map", "# "), 5, "structure.contact_dofs",
               "the scene has no structure.dof_map");
  expect_fault(replaced(named_scene, "gap = 1e-4", "gap = [\"node 20 x\"]"), 11, "contact.gap",
               "or a list of them");
}

TEST_F(NamedChain, FaultsOfTheMapNameItsFileAndThatOfTheMatrices) {
  folder_.write("chain.dof", "7.1\n20.1\n4.5\n4.6\n");
  expect_fault(named_scene, 7, "structure.dof_map",
               (folder_ / "chain.dof").string() + " names 4 rows; expected 3");
  expect_fault(named_scene, 7, "structure.dof_map", (folder_ / "k.mtx").string());
  folder_.write("chain.dof", "7.1\n20.9\n");
  expect_fault(named_scene, 7, "structure.dof_map", "chain.dof:2: the direction is \"9\"");
  expect_fault(replaced(named_scene, "chain.dof", "none.dof"), 7, "structure.dof_map", "cannot be opened");
}

TEST_F(NamedChain, HasTheSameMotionFromFilesOfCalculixAndOfHarwellAndBoeing) {
  folder_.write("k.sti", "1 1  2.e6\n1 2 -1.e6\n2 2  2.e6\n2 3 -1.e6\n3 3  1.e6\n");
  folder_.write("m.mas", "1 1 2.\n1 2 0.0\n2 2 2.\n3 3 2.\n");
  folder_.write("k.rsa",
                "chain\n 4 1 1 2 0\nRSA 3 3 5 0\n(4I3) (5I2) (1P,3D12.4)\n  1  3  5  6\n 1 2 2 3 3\n"
                "  2.0000D+06 -1.0000D+06  2.0000D+06\n -1.0000D+06  1.0000D+06\n");
  const Scene market = load(named_scene);
  const Eigen::VectorXd expected = weighted_residual_response(market).contacts.displacement.row(0);
  for (const std::string stiffness : {"k.sti", "k.rsa"}) {
    const Scene other = load(named_scene, {"structure.stiffness=" + stiffness, "structure.mass=m.mas"});
    const Eigen::VectorXd found = weighted_residual_response(other).contacts.displacement.row(0);
    EXPECT_EQ(found, expected) << stiffness;
  }
}

TEST_F(NamedChain, OfMatricesOfDifferentSizesNamesBothFiles) {
  folder_.write("m.mas", "1 1 2.\n2 2 2.\n");
  const auto details = fault(named_scene, {"structure.mass=m.mas"});
  for (const std::string& part : {(folder_ / "m.mas").string() + " is 2 x 2; expected 3 x 3",
                                  "structure.stiffness in " + (folder_ / "k.mtx").string()})
    EXPECT_NE(details.allowed.find(part), std::string::npos) << details.allowed;
}

TEST_F(NamedChain, HasTheFrequenciesCompliancesAndDampingRatiosOfTheClosedForm) {
  constexpr double eps = 1e-12;
  const auto omega = [](int mode) {
    return 2.0 * std::sqrt(1e6 / 2.0) * std::sin((2 * mode - 1) * std::numbers::pi / 14.0);
  };
  const StructureFacts facts = structure_facts(load(named_scene));
  ASSERT_EQ(facts.frequencies_hz.size(), 3);
  for (int mode = 1; mode <= 3; ++mode)
    EXPECT_NEAR(facts.frequencies_hz[mode - 1] * 2.0 * std::numbers::pi / omega(mode), 1.0, eps);
  EXPECT_EQ(facts.damping_ratios, Eigen::VectorXd::Constant(3, 0.01));
  EXPECT_EQ(facts.contacts, (std::vector<std::string>{"node 20 x", "-node 4 ry"}));
  EXPECT_NEAR(facts.compliances[0], 2e-6, eps * 2e-6);
  EXPECT_NEAR(facts.compliances[1], 3e-6, eps * 3e-6);
  const std::string undamped = replaced(named_scene, "modal_damping = 0.01", "# ");
  folder_.write("c.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 40\n2 2 40\n3 3 40\n");
  const StructureFacts damped = structure_facts(load(undamped, {"structure.damping=c.mtx"}));
  const StructureFacts beta = structure_facts(load(undamped, {"structure.stiffness_damping=1e-5"}));
  for (int mode = 1; mode <= 3; ++mode) {
    EXPECT_NEAR(damped.damping_ratios[mode - 1] / (40.0 / 2.0 / (2.0 * omega(mode))), 1.0, eps);
    EXPECT_NEAR(beta.damping_ratios[mode - 1] / (0.5e-5 * omega(mode)), 1.0, eps);
  }
}

TEST_F(NamedChain, IsDescribedWithTheNamesOfItsContacts) {
  const auto expect_part = [](const Scene& scene, const std::string& part) {
    const std::string text = describe_scene(scene);
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  };
  expect_part(load(named_scene), "modes      50.085, 140.33, 202.79 Hz, damping ratios 0.01 each\n");
  expect_part(load(named_scene), "compliance 2e-06 m/N at node 20 x; 3e-06 m/N at -node 4 ry\n");
  expect_part(load(chain_scene), "compliance 2e-06 m/N at row 2; 3e-06 m/N at row 3\n");
  expect_part(load(replaced(named_scene, "modal_damping = 0.01", "# ")), "Hz, without damping\n");
  std::string pairs;
  for (const char* dofs : {"[1]", "[2]", "[3]", "[2, 1]", "[3, 1]"})
    pairs += "[[contact.pairs]]\ndofs = " + std::string(dofs) + "\n";
  expect_part(load(replaced(replaced(named_scene, "contact_dofs", "# "), "[forcing]", pairs + "[forcing]")),
              "compliance from 1e-06 m/N at node 7 x to 3e-06 m/N at node 4 ry\n");
}

}  // namespace
