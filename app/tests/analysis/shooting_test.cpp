// analysis.type = "shooting", another name for the method of phases, beside time stepping and the balance.
#include <gtest/gtest.h>

#include "support/bar_scene.hpp"
#include "support/chain_files.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;

const std::string by_shooting = "analysis.type=shooting";

TEST(ShootingAnalysis, IsTheMotionAtWhichTimeSteppingArrives) {
  const Record shot = analyse(scene_of({by_shooting}));
  const Record stepped = analyse(scene_of({"analysis.type=time_stepping"}));
  ASSERT_TRUE(shot.converged) << shot.status;
  ASSERT_TRUE(stepped.converged) << stepped.status;
  const auto motion = [](const Record& record) -> Eigen::VectorXd {
    const auto values = record.response.numbers("displacement_m");
    return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  };
  EXPECT_LT(relative_rms_error(motion(shot), motion(stepped)), 1e-4);
  EXPECT_EQ(value_of<std::string>(shot.summary, "analysis"), "shooting");
}

TEST(ShootingAnalysis, HasTheMultipliersOfTheBalance) {
  const Record shot = analyse(scene_of({by_shooting}));
  const Record balance = analyse(scene_of({"time.functions=255", "time.quadrature_points=2048"}));
  ASSERT_TRUE(balance.converged) << balance.status;
  EXPECT_EQ(value_of<std::string>(shot.summary, "stability"), "stable");
  EXPECT_EQ(value_of<std::string>(balance.summary, "stability"), "stable");
  for (const char* part : {"leading_multiplier_real", "leading_multiplier_imag"})
    EXPECT_NEAR(value_of<double>(shot.summary, part), value_of<double>(balance.summary, part), 1e-3) << part;
}

/// The strip of reproduce/scenes/matrices with one contact and all its 72 modes.
Scene strip(std::vector<std::string> more) {
  for (const char* one : {"structure.contact_dofs=[54]", "contact.gap=1e-3"}) more.emplace_back(one);
  return load_scene(std::string(WAVEBALANCE_SCENES) + "/matrices/strip_forced.toml", more,
                    std::vector<std::string>{"analysis.motion_points"});
}

// Time stepping would follow the fastest of the modes through its transient.
TEST(ShootingAnalysis, TakesMatricesWithoutReduction) {
  const Response shot = phases_response(strip({by_shooting}));
  const Response balance =
      weighted_residual_response(strip({"time.functions=255", "time.quadrature_points=1024"}));
  ASSERT_TRUE(shot.converged) << shot.status;
  ASSERT_TRUE(balance.converged) << balance.status;
  EXPECT_GT(shot.force().maxCoeff(), 1.0);
  EXPECT_LT(relative_rms_error(balance.displacement(), shot.displacement()), 1e-3);
}

TEST(ShootingAnalysis, FindsAnUnstableMotion) {
  const Record record = analyse(strip({by_shooting, "forcing.frequency=80", "forcing.amplitude=20"}));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_LT(value_of<double>(record.summary, "residual"), 1e-8);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "unstable");
}

TEST(ShootingAnalysis, IsWhatTheMethodOfPhasesFinds) {
  const Record shot = analyse(scene_of({by_shooting}));
  const Record phases = analyse(parse_scene(
      bar_scene, "case.toml", std::vector<std::string>{"time.method=phases"},
      std::vector<std::string>{"time.trial", "time.weight", "time.functions", "time.quadrature_points"}));
  ASSERT_TRUE(shot.converged && phases.converged);
  EXPECT_EQ(shot.response.numbers("displacement_m"), phases.response.numbers("displacement_m"));
  EXPECT_EQ(value_of<std::string>(shot.summary, "solved_by"), "phases");
}

TEST(ShootingAnalysis, IsDescribedBeforeItRuns) {
  const std::string text = describe_scene(scene_of({by_shooting}));
  EXPECT_NE(text.find("phases of contact to a relative error of 1e-9"), std::string::npos) << text;
  EXPECT_EQ(text.find("functions"), std::string::npos) << text;
}

class ShootingScene : public testing::Test {
 protected:
  ShootingScene() { write_chain(folder_); }
  Record solve(const std::string& text) const {
    return analyse(load_scene(folder_.write("case.toml", text), std::vector<std::string>{by_shooting}));
  }

  TemporaryFolder folder_;
};

TEST_F(ShootingScene, TakesSeveralContactsDampingThatCouplesTheModesAndForcesOfTheVelocity) {
  folder_.write("c.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 50\n2 2 20\n3 3 5\n");
  const std::string coupled = with(chain_scene, "modal_damping = 0.01 ", "damping = \"c.mtx\"");
  for (const std::string& text :
       {chain_scene, coupled,
        with(with(chain_scene, "\"linear\" ", "\"kelvin_voigt\" "), "gap =", "damping = 10.0\ngap =")}) {
    const Record record = solve(text);
    EXPECT_TRUE(record.converged) << record.status;
    EXPECT_EQ(record.contacts.empty(), false);
  }
}

}  // namespace
