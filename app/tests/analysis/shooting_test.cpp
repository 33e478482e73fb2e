// analysis.type = "shooting" beside time stepping and the balance.
#include <gtest/gtest.h>

#include "support/bar_scene.hpp"
#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/solvers/period/shooting.hpp"

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
  const Response shot = shooting_response(strip({by_shooting}));
  const Response balance =
      weighted_residual_response(strip({"time.functions=255", "time.quadrature_points=1024"}));
  ASSERT_TRUE(shot.converged) << shot.status;
  ASSERT_TRUE(balance.converged) << balance.status;
  EXPECT_GT(shot.force().maxCoeff(), 1.0);
  EXPECT_LT(relative_rms_error(balance.displacement(), shot.displacement()), 1e-3);
}

TEST(ShootingAnalysis, FindsAnUnstableMotionToWhichTenPeriodsDoNotLead) {
  const Scene scene = strip({by_shooting, "forcing.frequency=80", "forcing.amplitude=20"});
  const StructureModel model = make_model(scene);
  const auto from_rest =
      wavebalance::solvers::shoot(model.structure, make_laws(scene)[0], scene.forcing.frequency);
  ASSERT_NE(from_rest.status, wavebalance::solvers::ShootingStatus::converged);
  const Response response = shooting_response(scene, model);
  ASSERT_TRUE(response.converged) << response.status;
  EXPECT_LT(response.residual, 1e-10);
  EXPECT_EQ(response.stability->status, "unstable");
}

TEST(ShootingAnalysis, IsDescribedBeforeItRuns) {
  const std::string text = describe_scene(scene_of({by_shooting}));
  EXPECT_NE(text.find("size       50 states"), std::string::npos) << text;
  EXPECT_EQ(text.find("functions"), std::string::npos) << text;
}

class ShootingScene : public testing::Test {
 protected:
  ShootingScene() { write_chain(folder_); }
  Scene load(const std::string& text) const {
    return load_scene(folder_.write("case.toml", text), std::vector<std::string>{by_shooting});
  }
  SceneError::Details error_of(const std::string& text) const {
    return details_of_error([&](const std::string& one) { load(one); }, text);
  }
  std::string one_contact() const { return with(chain_scene, "[2, 3]", "[3]"); }

  TemporaryFolder folder_;
};

TEST_F(ShootingScene, RefusesWhatShootingDoesNotKnowAtItsKey) {
  const auto several = error_of(chain_scene);
  EXPECT_EQ(several.key, "structure.contact_dofs");
  EXPECT_NE(several.allowed.find("there are 2 contacts, and shooting knows one"), std::string::npos);
  EXPECT_NE(several.allowed.find("expected analysis.type = \"time_stepping\""), std::string::npos);
  EXPECT_EQ(error_of(with(with(one_contact(), "\"linear\" ", "\"kelvin_voigt\" "),
                          "gap =", "damping = 10.0\ngap ="))
                .key,
            "contact.law");
  EXPECT_EQ(error_of(with(with(one_contact(), "\"linear\" ", "\"rigid\" "), "stiffness = 1e7", "")).key,
            "contact.law");
}

TEST_F(ShootingScene, RefusesDampingThatCouplesTheModesAndWritesNoRecord) {
  folder_.write("c.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 1\n1 1 50\n");
  const std::string damped = with(one_contact(), "modal_damping = 0.01 ", "damping = \"c.mtx\"");
  const Scene scene = load_scene(folder_.write("case.toml", damped), std::vector<std::string>{by_shooting});
  try {
    analyse(scene);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("analysis.type = \"shooting\": shoot: damping couples"), std::string::npos) << text;
    EXPECT_NE(text.find("expected \"time_stepping\""), std::string::npos) << text;
  }
}

}  // namespace
