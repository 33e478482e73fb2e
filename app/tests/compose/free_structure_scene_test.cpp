// Structures that are free to move, with the example reproduce/scenes/matrices/free_rod, and structural
// damping.
#include <gtest/gtest.h>

#include <sstream>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace {

using namespace wavebalance::app;
namespace solvers = wavebalance::solvers;

Scene free_rod(const std::vector<std::string>& overrides = {}, const std::vector<std::string>& removed = {}) {
  return load_scene(std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "free_rod" / "free_rod.toml",
                    overrides, removed);
}

TEST(FreeRodScene, MovesBetweenItsStopsAsTimeSteppingSays) {
  const Response response = weighted_residual_response(free_rod());
  ASSERT_TRUE(response.converged) << response.status;
  for (int contact = 0; contact < 2; ++contact)
    EXPECT_GT(response.contacts.force.row(contact).maxCoeff(), 100.0) << contact;
  const Response stepped = time_stepping_response(free_rod({"analysis.type=time_stepping"}));
  ASSERT_TRUE(stepped.converged) << stepped.status;
  EXPECT_LT((response.contacts.displacement - stepped.contacts.displacement).norm(),
            5e-3 * stepped.contacts.displacement.norm());
}

TEST(FreeRodScene, IsDescribedAndSolvedByTheCommand) {
  const std::string text = describe_scene(free_rod());
  EXPECT_NE(text.find("free to move"), std::string::npos) << text;
  EXPECT_TRUE(analyse(free_rod()).converged);
}

TEST(FreeRodScene, MovesInASweepAsInTheForcedResponse) {
  constexpr double driven = 60.0;
  const std::string at = std::to_string(driven);
  const Record response = analyse(free_rod({"forcing.frequency=" + at, "analysis.motion_points=8",
                                            "analysis.stability=false", "analysis.phases=false"}));
  const Record curve = analyse(
      free_rod({"analysis.type=frequency_sweep", "analysis.stability=false", "analysis.frequency_from=58",
                "analysis.frequency_to=62", "analysis.motion_at=" + at, "analysis.motion_points=8"},
               {"forcing.frequency"}));
  const auto motion = [](const Record& record, const std::string& name) {
    for (const RecordFile& file : record.files) {
      std::istringstream text(file.contents);
      if (file.name == name) return Eigen::MatrixXd(wavebalance::fem::read_matrix_market(text, name));
    }
    ADD_FAILURE() << name << " is not written";
    return Eigen::MatrixXd();
  };
  const Eigen::MatrixXd expected = motion(response, "motion.mtx"), found = motion(curve, "motion_60Hz.mtx");
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
}

TEST(FreeRodScene, ReducedToItsModesMovesLikeTheWholeOne) {
  const Response whole = weighted_residual_response(free_rod()),
                 reduced = weighted_residual_response(free_rod({"structure.kept_modes=7"}));
  ASSERT_TRUE(reduced.converged) << reduced.status;
  EXPECT_LT((reduced.contacts.displacement - whole.contacts.displacement).norm(),
            1e-6 * whole.contacts.displacement.norm());
}

TEST(FreeRodScene, SaysThatNoPeriodicMotionExistsWhereNothingBalancesItsLoad) {
  Scene scene = free_rod();
  StructureModel model = make_model(scene);
  model.structure.forces.push_back(
      {Eigen::VectorXd::Unit(9, 8), Eigen::VectorXcd::Constant(1, std::complex<double>(-50.0)), 0});
  scene.structure.matrices.contact_dofs = {9, 5};
  model.structure.contact_directions = solvers::contact_rows({8, 4}, 9);  // both stops on one side
  const Response response = weighted_residual_response(scene, model);
  EXPECT_FALSE(response.converged);
  EXPECT_EQ(response.status, "unbalanced");
}

const std::string free_chain =
    "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 1e6\n2 1 -1e6\n2 2 2e6\n3 2 -1e6\n3 3 1e6\n";

TEST(FreeStructureScene, IsAnErrorUnlessMeant) {
  TemporaryFolder folder;
  write_chain(folder);
  folder.write("k.mtx", free_chain);
  const auto error = [&](const std::string& text) {
    return details_of_error([&](const std::string& one) { load_scene(folder.write("case.toml", one)); },
                            text);
  };
  EXPECT_NE(error(chain_scene).allowed.find("Say structure.free = true"), std::string::npos);
  const std::string meant = with(chain_scene, "contact_dofs = [2, 3]", "free = true\ncontact_dofs = [2, 3]");
  const Scene scene = load_scene(folder.write("meant.toml", meant));
  EXPECT_EQ(make_structure(scene).rigid_modes.cols(), 1);
  const std::string rigid = with(meant, "\"linear\"", "\"rigid\"");
  EXPECT_EQ(error(with(rigid, "stiffness = 1e7 ", "")).key, "structure.free");
  EXPECT_EQ(error(with(meant, "forced_response", "nonlinear_mode")).key, "structure.free");
  folder.write("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 1\n2 2 -1\n3 3 1\n");
  EXPECT_NE(error(meant).allowed.find("not positive semidefinite"), std::string::npos);
}

TEST(LossFactor, OfTheBarLimitsItsResonance) {
  const std::string text = with(bar_scene, "stiffness_damping = 1e-4", "loss_factor = 0.1");
  const Scene scene =
      parse_scene(text, "case.toml", std::vector<std::string>{"contact.law=none", "forcing.frequency=300"},
                  std::vector<std::string>{"contact.constant", "contact.exponent", "contact.gap"});
  EXPECT_EQ(make_structure(scene).loss_factor, 0.1);
  const Response response = weighted_residual_response(scene, {.stability = true});
  ASSERT_TRUE(response.converged);
  ASSERT_TRUE(response.stability);
  EXPECT_EQ(response.stability->status, "structural_damping");
  EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
}

TEST(LossFactor, IsRefusedWhereMotionsFollowTime) {
  const std::string text = with(bar_scene, "stiffness_damping = 1e-4", "loss_factor = 0.1");
  EXPECT_NE(error_of(text, {"analysis.type=time_stepping"}).allowed.find("no equation in time"),
            std::string::npos);
  EXPECT_EQ(error_of(with(bar_scene, "stiffness_damping = 1e-4", "loss_factor = -0.1")).key,
            "structure.loss_factor");
  EXPECT_EQ(error_of(rod_scene, {"structure.loss_factor=0.1"}).key, "structure.loss_factor");
}

}  // namespace
