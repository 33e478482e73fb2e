// time.method = "phases": the motion of the structure itself in place of a balance.
#include <gtest/gtest.h>

#include "period_oracle/rigid_reference.hpp"
#include "support/bar_scene.hpp"
#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

const std::vector<std::string> balance_keys{"time.trial", "time.weight", "time.functions",
                                            "time.quadrature_points"};

Scene bar_by_phases(std::vector<std::string> more = {}) {
  more.emplace_back("time.method=phases");
  return parse_scene(bar_scene, "case.toml", more, balance_keys);
}

TEST(PhasesMethod, IsTheMotionThatFineBalancesTendTo) {
  const Response phases = phases_response(bar_by_phases());
  ASSERT_TRUE(phases.converged) << phases.status;
  double before = 1.0;
  for (const char* functions : {"63", "255", "1023"}) {
    const Response balance = weighted_residual_response(
        scene_of({std::string("time.functions=") + functions, "time.quadrature_points=8192"}));
    ASSERT_TRUE(balance.converged);
    const double error = relative_rms_error(balance.displacement(), phases.displacement());
    EXPECT_LT(error, 0.2 * before) << functions;
    before = error;
  }
  EXPECT_LT(before, 1e-5);
}

TEST(PhasesMethod, IsTheMotionAtWhichTimeSteppingArrives) {
  const Response phases = phases_response(bar_by_phases());
  const Response stepped = time_stepping_response(scene_of({"analysis.type=time_stepping"}));
  ASSERT_TRUE(phases.converged && stepped.converged);
  EXPECT_LT(relative_rms_error(phases.displacement(), stepped.displacement()), 1e-4);
}

TEST(PhasesMethod, MeetsItsToleranceAndSaysFromWhereItStarted) {
  const Response exact = phases_response(bar_by_phases({"time.tolerance=1e-12"}));
  ASSERT_TRUE(exact.converged) << exact.status;
  for (const char* tolerance : {"1e-4", "1e-7", "1e-10"}) {
    const Record record = analyse(bar_by_phases({std::string("time.tolerance=") + tolerance}));
    ASSERT_TRUE(record.converged) << record.status;
    EXPECT_LE(value_of<double>(record.summary, "phases_estimated_error"), std::stod(tolerance));
    EXPECT_EQ(value_of<double>(record.summary, "tolerance"), std::stod(tolerance));
    const auto values = record.response.numbers("displacement_m");
    const Eigen::VectorXd found = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
    EXPECT_LT(relative_rms_error(found, exact.displacement()), std::stod(tolerance));
    EXPECT_EQ(value_of<std::string>(record.summary, "strategy"), "from_balance");
    EXPECT_EQ(value_of<std::int64_t>(record.summary, "start_functions"), 63);
    EXPECT_EQ(value_of<Table>(record.summary, "phases").rows(), 1u);
    EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
    EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "phases");
    EXPECT_EQ(find_entry(record.summary, "functions"), nullptr);
    EXPECT_LE(value_of<double>(record.summary, "structure_left_out"), 1.001e-4);
    EXPECT_EQ(record.bar_motion.rows(), 26);
  }
}

TEST(PhasesMethod, HasTheWholeStructureNearThatOfAFineBalance) {
  const ResponseOptions options{.structure_points = 64};
  const Response phases = phases_response(bar_by_phases(), options);
  const Response balance =
      weighted_residual_response(scene_of({"time.functions=1023", "time.quadrature_points=8192"}), options);
  ASSERT_EQ(phases.structure.displacement.rows(), balance.structure.displacement.rows());
  EXPECT_LT((phases.structure.displacement - balance.structure.displacement).norm(),
            1e-5 * balance.structure.displacement.norm());
  EXPECT_LT((phases.structure.velocity - balance.structure.velocity).norm(),
            1e-3 * balance.structure.velocity.norm());
  EXPECT_LE(phases.structure_left_out, 1e-9);
}

TEST(PhasesMethod, TakesARigidObstacleAtATipWithoutMass) {
  const Scene scene = load_scene(
      WAVEBALANCE_SCENES "/jones_legrand_2014/case1_rigid.toml",
      std::vector<std::string>{"time.method=phases"},
      std::vector<std::string>{"time.trial", "time.weight", "time.functions", "time.quadrature_points",
                               "time.formulation", "time.inner_products"});
  const Response phases = phases_response(scene);
  ASSERT_TRUE(phases.converged) << phases.status;
  ASSERT_TRUE(phases.rigid.has_value());
  EXPECT_LT(phases.rigid->max_penetration, 1e-9 * scene.contact.gap);
  EXPECT_GT(phases.rigid->min_force, -1e-6 * phases.force().maxCoeff());
}

// One panel of many nodes loses its digits over half a period of a bar with fast modes.
TEST(PhasesMethod, DividesThePanelsOfLongContact) {
  for (const char* gap : {"3e-4", "1e-4", "3e-5"}) {
    const Scene scene = load_scene(
        WAVEBALANCE_SCENES "/jones_legrand_2014/case1_rigid.toml",
        std::vector<std::string>{"time.method=phases", "time.tolerance=1e-12", "forcing.frequency=90",
                                 std::string("contact.gap=") + gap},
        std::vector<std::string>{"time.trial", "time.weight", "time.functions", "time.quadrature_points",
                                 "time.formulation", "time.inner_products"});
    const Response phases = phases_response(scene);
    ASSERT_TRUE(phases.converged) << gap << ": " << phases.status;
    const auto joined = oracle::rigid_reference(make_model(scene).structure, scene.contact.gap, 90.0,
                                                scene.analysis.output_points);
    ASSERT_TRUE(joined.converged) << gap;
    EXPECT_LT(relative_rms_error(phases.displacement(), joined.displacement), 1e-7) << gap;
  }
}

TEST(PhasesMethod, NamesWhyItDoesNotApplyAndWritesNoMotion) {
  const Record record =
      analyse(bar_by_phases({"structure.loss_factor=0.02", "structure.stiffness_damping=0"}));
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status, "structural_damping");
  EXPECT_TRUE(record.response.empty());
}

TEST(PhasesMethod, ComesBackFromItsSceneAsItIsWritten) {
  const Scene scene = bar_by_phases({"time.tolerance=1e-11"});
  EXPECT_EQ(parse_scene(write_scene(scene), "written.toml"), scene);
  const std::string text = describe_scene(scene);
  EXPECT_NE(text.find("phases of contact to a relative error of 1e-11"), std::string::npos) << text;
}

TEST(PhasesMethod, RefusesTheKeysOfABalanceByName) {
  const auto refused = [](const std::string& key, const std::string& value) {
    try {
      bar_by_phases({key + "=" + value});
    } catch (const SceneError& error) {
      EXPECT_EQ(error.details().key, key);
      return std::string(error.what()).find("time.method") != std::string::npos;
    }
    return false;
  };
  for (const auto& [key, value] : {std::pair{"time.trial", "fourier"},
                                   {"time.weight", "haar"},
                                   {"time.functions", "63"},
                                   {"time.quadrature_points", "256"},
                                   {"time.formulation", "weak"},
                                   {"time.inner_products", "exact"},
                                   {"time.nyquist", "keep"},
                                   {"time.sample_offset", "0.5"},
                                   {"contact.form", "force"},
                                   {"analysis.phases", "true"},
                                   {"analysis.subharmonic", "2"}})
    EXPECT_TRUE(refused(key, value)) << key;
  EXPECT_THROW(bar_by_phases({"time.tolerance=1e-14"}), SceneError);
  EXPECT_THROW(bar_by_phases({"time.tolerance=0"}), SceneError);
  EXPECT_THROW(scene_of({"analysis.type=time_stepping", "time.method=phases"}), SceneError);
}

/// The bar with a tolerance in place of sizes.
Scene bar_to(const char* tolerance, std::vector<std::string> more = {}) {
  more.push_back(std::string("time.tolerance=") + tolerance);
  std::vector<std::string> without{"time.functions", "time.quadrature_points"};
  return parse_scene(bar_scene, "case.toml", more, without);
}

TEST(SmallTolerance, IsMetByPhasesFromACoarseBalance) {
  const Response exact = phases_response(bar_by_phases({"time.tolerance=1e-12"}));
  for (const char* tolerance : {"1e-7", "1e-9", "1e-11"}) {
    const Record record = analyse(bar_to(tolerance));
    ASSERT_TRUE(record.converged) << record.status;
    EXPECT_EQ(value_of<std::string>(record.summary, "solved_by"), "phases");
    EXPECT_EQ(value_of<std::int64_t>(record.summary, "start_functions"), 63);
    EXPECT_LE(value_of<double>(record.summary, "estimated_error"), std::stod(tolerance));
    const auto values = record.response.numbers("displacement_m");
    const Eigen::VectorXd found = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
    EXPECT_LT(relative_rms_error(found, exact.displacement()), std::stod(tolerance));
  }
}

TEST(SmallTolerance, IsMetByARefinedBalanceWherePhasesDoNotApplyAndInBasesThatAreNamed) {
  const Response large = weighted_residual_response(bar_to("1e-6"));
  EXPECT_EQ(large.solved_by, "balance");
  EXPECT_TRUE(large.refinement.has_value());
  const Response damped = weighted_residual_response(
      bar_to("5e-7", {"structure.loss_factor=0.02", "structure.stiffness_damping=0"}));
  EXPECT_TRUE(damped.converged) << damped.status;
  EXPECT_EQ(damped.solved_by, "balance");
  const Response named =
      weighted_residual_response(bar_to("5e-7", {"time.trial=bspline", "time.weight=bspline"}));
  EXPECT_EQ(named.solved_by, "balance");
  EXPECT_EQ(named.refinement->trial, "bspline");
}

TEST(SmallTolerance, HasAPictureWhereTheSceneNamesNoBasis) {
  const Record record = analyse(parse_scene(
      bar_scene, "case.toml", std::vector<std::string>{"time.tolerance=1e-8"},
      std::vector<std::string>{"time.functions", "time.quadrature_points", "time.trial", "time.weight"}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "solved_by"), "phases");
}

TEST(SmallTolerance, HasALimit) {
  EXPECT_NO_THROW(bar_to("1e-13"));
  EXPECT_THROW(bar_to("9e-14"), SceneError);
}

class PhasesMethodOfAChain : public testing::Test {
 protected:
  PhasesMethodOfAChain() { write_chain(folder_); }
  TemporaryFolder folder_;
};

TEST_F(PhasesMethodOfAChain, MeetsASmallToleranceWithSeveralContacts) {
  const Response found = weighted_residual_response(
      load_scene(folder_.write("chain.toml", chain_scene), std::vector<std::string>{"time.tolerance=1e-10"},
                 std::vector<std::string>{"time.functions"}));
  ASSERT_TRUE(found.converged) << found.status;
  EXPECT_EQ(found.solved_by, "phases");
  EXPECT_LE(found.phases->motion.estimated_error, 1e-10);
}

TEST_F(PhasesMethodOfAChain, TakesSeveralContacts) {
  const auto place = folder_.write("chain.toml", chain_scene);
  const Response phases =
      phases_response(load_scene(place, std::vector<std::string>{"time.method=phases"},
                                 std::vector<std::string>{"time.trial", "time.weight", "time.functions"}));
  ASSERT_TRUE(phases.converged) << phases.status;
  EXPECT_EQ(phases.contacts.rows(), 2);
  const Response balance = weighted_residual_response(
      load_scene(place, std::vector<std::string>{"time.functions=1023", "time.quadrature_points=4096"}));
  ASSERT_TRUE(balance.converged);
  EXPECT_LT((phases.contacts.displacement - balance.contacts.displacement).norm(),
            1e-4 * balance.contacts.displacement.norm());
}

}  // namespace
}  // namespace wavebalance::app
