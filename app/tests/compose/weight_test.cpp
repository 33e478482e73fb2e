// Directions of a dof map: base motion along one, the weight of all masses, loads of single terms, and where
// a structure stands under its static loads.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/rest_state.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace {

using namespace wavebalance::app;

class MappedChain : public testing::Test {
 protected:
  MappedChain() {
    write_chain(folder_);
    folder_.write("chain.dof", "7.3\n20.3\n4.1\n");  // z, z and x
    folder_.write("g.mtx", "%%MatrixMarket matrix array real general\n3 1\n0.5\n0\n-2\n");
    folder_.write("short.mtx", "%%MatrixMarket matrix array real general\n2 1\n1\n1\n");
  }

  /// The chain with a map and these lines in its forcing, of amplitude 0.
  Scene load(const std::string& lines, const std::vector<std::string>& overrides = {}) const {
    return parse_scene(text(lines), (folder_.path() / "case.toml").string(), overrides);
  }
  std::string text(const std::string& lines) const {
    const std::string mapped =
        with(chain_scene, "modal_damping = 0.01", "dof_map = \"chain.dof\"\nmodal_damping = 0.01");
    return with(with(mapped, "amplitude = 100.0", "amplitude = 0.0"), "[time]", lines + "\n[time]");
  }
  std::string term(const std::string& lines) const { return "[[forcing.terms]]\n" + lines; }
  Eigen::VectorXd shape(const Scene& scene) const {
    const auto forces = make_model(scene).structure.forces;
    EXPECT_EQ(forces.size(), 1u);
    return forces.empty() ? Eigen::VectorXd()
                          : Eigen::VectorXd(forces[0].shape * forces[0].harmonics.sum().real());
  }
  void expect_fault(const std::string& lines, const std::string& key, const std::string& part,
                    const std::vector<std::string>& overrides = {}) const {
    const auto found = details_of_error([&](const std::string& one) { load(one, overrides); }, lines);
    EXPECT_EQ(found.key, key) << found.allowed;
    EXPECT_NE(found.allowed.find(part), std::string::npos) << found.allowed;
  }

  TemporaryFolder folder_;
};

TEST_F(MappedChain, WeighsAsItsMassesTimesTheAccelerationAlongTheirRows) {
  EXPECT_TRUE(shape(load("weight = [0, 0, -9.81]")).isApprox(Eigen::Vector3d(-19.62, -19.62, 0.0), 1e-14));
  EXPECT_TRUE(shape(load("weight = [3.0, 0, -9.81]")).isApprox(Eigen::Vector3d(-19.62, -19.62, 6.0), 1e-14));
}

TEST_F(MappedChain, IsShakenAlongADirectionAsByTheRowsThatPointThere) {
  const std::string base = "kind = \"base_acceleration\"\namplitude = 30.0\n";
  const Eigen::VectorXd rows = shape(load(term(base + "dofs = [1, 2]")));
  EXPECT_TRUE(shape(load(term(base + "direction = \"z\""))).isApprox(rows, 1e-15));
  EXPECT_TRUE(shape(load(term(base + "direction = \"-z\""))).isApprox(-rows, 1e-15));
}

TEST_F(MappedChain, TakesALoadVectorForEachTerm) {
  EXPECT_TRUE(shape(load(term("amplitude = 4.0\nload = \"g.mtx\"")))
                  .isApprox(Eigen::Vector3d(2.0, 0.0, -8.0), 1e-15));
}

TEST_F(MappedChain, KeepsTheRowsOfPointLoadsBesideALoadOnManyRows) {
  std::string many = "%%MatrixMarket matrix array real general\n40 1\n",
              rows = "%%MatrixMarket matrix coordinate real symmetric\n40 40 79\n",
              masses = "%%MatrixMarket matrix coordinate real symmetric\n40 40 40\n";
  for (int i = 1; i <= 40; ++i) {
    many += "1\n";
    masses += std::to_string(i) + " " + std::to_string(i) + " 2\n";
    rows += std::to_string(i) + " " + std::to_string(i) + (i < 40 ? " 2e6\n" : " 1e6\n");
    if (i > 1) rows += std::to_string(i) + " " + std::to_string(i - 1) + " -1e6\n";
  }
  folder_.write("k.mtx", rows);
  folder_.write("m.mtx", masses);
  folder_.write("many.mtx", many);
  const std::string loads =
      term("harmonic = 0\namplitude = 1.0\nload = \"many.mtx\"\n") + term("dofs = [17]\namplitude = 1.0");
  const Scene scene = parse_scene(
      with(with(chain_scene, "amplitude = 100.0", "amplitude = 0.0"), "[time]", loads + "\n[time]"),
      (folder_.path() / "case.toml").string(), std::vector<std::string>{"structure.kept_modes=5"});
  EXPECT_EQ(reduced_size(scene), 3 + 5) << "rows 2, 3 and 17, and the modes";
}

// K u + k (u_3 - g) e_3 = f where the last mass alone touches.
TEST_F(MappedChain, StandsUnderItsStaticLoadsWithTheContactsThatTheyClose) {
  const Scene scene =
      load(term("harmonic = 0\namplitude = 300.0\ndofs = [3]\n") + term("amplitude = 5.0\ndofs = [1]"),
           {"contact.gap=[1.0, 1e-4]"});
  Eigen::Matrix3d stiffness;
  stiffness << 2e6, -1e6, 0, -1e6, 2e6, -1e6, 0, -1e6, 1e6 + 1e7;
  const Eigen::Vector3d u = stiffness.lu().solve(Eigen::Vector3d(0, 0, 300.0 + 1e7 * 1e-4));
  for (const std::optional<RestState>& rest : {rest_state(scene), rest_state(scene, make_model(scene))}) {
    ASSERT_TRUE(rest);
    ASSERT_TRUE(rest->converged) << rest->status;
    EXPECT_TRUE(rest->displacement.isApprox(u.tail(2), 1e-10)) << rest->displacement << u;
    EXPECT_NEAR(rest->force[1], 1e7 * (u[2] - 1e-4), 1e-8 * rest->force[1]);
    EXPECT_EQ(rest->force[0], 0.0);
  }
  const Table at_rest = value_of<Table>(analyse(scene).summary, "at_rest");
  EXPECT_NEAR(at_rest.numbers("displacement_m")[1], u[2], 1e-10 * u[2]);
  const std::string text = describe_scene(scene);
  EXPECT_NE(text.find("at rest    1 of 2 contacts is closed under the static loads"), std::string::npos)
      << text;
}

TEST_F(MappedChain, StandsOnARigidObstacleToo) {
  const std::string rigid = with(
      with(text(term("harmonic = 0\namplitude = 300.0\ndofs = [3]\n") + term("amplitude = 5.0\ndofs = [1]")),
           "law = \"linear\"", "law = \"rigid\""),
      "stiffness = 1e7", "");
  const Scene scene = parse_scene(rigid, (folder_.path() / "case.toml").string(),
                                  std::vector<std::string>{"contact.gap=[1.0, 1e-4]"});
  const std::optional<RestState> rest = rest_state(scene);
  ASSERT_TRUE(rest);
  ASSERT_TRUE(rest->converged) << rest->status;
  EXPECT_NEAR(rest->displacement[1], 1e-4, 1e-12);
  EXPECT_GT(rest->force[1], 0.0);
}

TEST_F(MappedChain, ThatIsFreeToMoveStandsWhereItsContactBalancesTheLoad) {
  folder_.write("k.mtx", with(chain_stiffness, "1 1 2e6", "1 1 1e6"));
  const std::string free = with(
      with(text(term("harmonic = 0\namplitude = 10.0\ndofs = [1]\n") + term("amplitude = 5.0\ndofs = [1]")),
           "modal_damping", "free = true\nmodal_damping"),
      "[2, 3]", "[3]");
  const Scene scene = parse_scene(free, (folder_.path() / "case.toml").string());
  const std::optional<RestState> rest = rest_state(scene);
  ASSERT_TRUE(rest);
  ASSERT_TRUE(rest->converged) << rest->status;
  EXPECT_NEAR(rest->force[0], 10.0, 1e-6);
  EXPECT_NEAR(rest->displacement[0], 1e-4 + 10.0 / 1e7, 1e-10);
}

TEST_F(MappedChain, WithoutStaticLoadsHasNothingToSayOfRest) {
  const Scene scene = load(term("amplitude = 5.0\ndofs = [1]"));
  EXPECT_TRUE(rest_state(scene)->trivial());
  EXPECT_EQ(find_entry(analyse(scene).summary, "at_rest"), nullptr);
  EXPECT_EQ(describe_scene(scene).find("at rest"), std::string::npos);
}

TEST_F(MappedChain, SaysWhichDirectionsAndLoadsAreWrong) {
  const std::string base = "kind = \"base_acceleration\"\namplitude = 30.0\n";
  expect_fault("weight = [0, 0]", "forcing.weight", "expected a list of 3 numbers");
  expect_fault("weight = [0, 1.0, 0]", "forcing.weight", "moves along y");
  expect_fault(term(base + "direction = \"y\""), "forcing.terms[1].direction", "moves along y");
  expect_fault(term(base + "direction = \"up\""), "forcing.terms[1].direction", "\"-z\"");
  expect_fault(term(base + "direction = \"z\"\ndofs = [1]"), "forcing.terms[1].direction",
               "one or the other");
  expect_fault(term("amplitude = 1.0\ndirection = \"z\""), "forcing.terms[1].direction",
               "only with kind = \"base_acceleration\"");
  expect_fault(term(base + "load = \"g.mtx\""), "forcing.terms[1].load", "only with kind = \"force\"");
  expect_fault(term("amplitude = 1.0\nload = \"g.mtx\"\ndofs = [1]"), "forcing.terms[1].load",
               "one or the other");
  expect_fault(term("amplitude = 1.0\nload = \"short.mtx\""), "forcing.terms[1].load", "has 2 entries");
  expect_fault(term("amplitude = 1.0\nload = \"none.mtx\""), "forcing.terms[1].load", "none.mtx");
  const auto unmapped = [&](const std::string& lines) {
    return details_of_error(
        [&](const std::string& one) {
          parse_scene(with(text(one), "dof_map = \"chain.dof\"", ""),
                      (folder_.path() / "case.toml").string());
        },
        lines);
  };
  EXPECT_NE(unmapped("weight = [0, 0, 1.0]").allowed.find("structure.dof_map"), std::string::npos);
  EXPECT_NE(unmapped(term(base + "direction = \"z\"")).allowed.find("structure.dof_map"), std::string::npos);
}

TEST_F(MappedChain, WritesItsDirectionsAndLoadsAndReadsThemBack) {
  const Scene scene = load("weight = [0, 0, -9.81]\n" + term("amplitude = 4.0\nload = \"g.mtx\"\n") +
                           term("kind = \"base_acceleration\"\namplitude = 30.0\ndirection = \"-z\""));
  const Scene again = parse_scene(write_scene(scene), (folder_.path() / "case.toml").string());
  EXPECT_EQ(again, scene) << write_scene(scene);
  const std::string text = describe_scene(scene);
  EXPECT_NE(text.find("weight: static, [0.0, 0.0, -9.81] m/s^2, 39.24 N in all"), std::string::npos) << text;
  EXPECT_NE(text.find("30 m/s^2 along -z"), std::string::npos) << text;
}

}  // namespace
