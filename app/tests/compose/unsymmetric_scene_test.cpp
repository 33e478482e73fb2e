// Matrices without symmetry: the example reproduce/scenes/matrices/rotor and small changes of the chain.
#include <gtest/gtest.h>

#include "support/chain_files.hpp"
#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;
namespace solvers = wavebalance::solvers;

Scene rotor(const std::vector<std::string>& overrides = {}, const std::vector<std::string>& removed = {}) {
  return load_scene(std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "rotor" / "rotor.toml",
                    overrides, removed);
}

TEST(RotorScene, StrikesItsStopAsTimeSteppingSays) {
  const Response response = weighted_residual_response(rotor());
  ASSERT_TRUE(response.converged) << response.status;
  EXPECT_GT(response.contacts.force.maxCoeff(), 10.0);
  const Response stepped = time_stepping_response(rotor({"analysis.type=time_stepping"}));
  ASSERT_TRUE(stepped.converged) << stepped.status;
  ASSERT_EQ(stepped.contacts.points(), response.contacts.points());
  const Eigen::MatrixXd difference = response.contacts.displacement - stepped.contacts.displacement;
  EXPECT_LT(difference.norm(), 1e-3 * stepped.contacts.displacement.norm());
}

TEST(RotorScene, FluttersWhereTheDampingOfTheShaftExceedsThatOutside) {
  TemporaryFolder folder;
  const auto from = std::filesystem::path(WAVEBALANCE_SCENES) / "matrices" / "rotor";
  for (const char* file : {"mass.mtx", "damping.mtx", "rotor.toml"})
    std::filesystem::copy_file(from / file, folder / file);
  for (const double circulatory : {6000.0, 12000.0}) {
    folder.write("stiffness.mtx",
                 "%%MatrixMarket matrix coordinate real general\n4 4 10\n1 1 801577.366\n2 1 " +
                     std::to_string(-circulatory) + "\n3 1 -200394.341\n1 2 " + std::to_string(circulatory) +
                     "\n2 2 801577.366\n4 2 -200394.341\n1 3 -200394.341\n3 3 66798.1138\n2 4 -200394.341\n"
                     "4 4 66798.1138\n");
    const Response response = weighted_residual_response(
        load_scene(folder / "rotor.toml", std::vector<std::string>{"contact.law=none"},
                   std::vector<std::string>{"contact.stiffness", "contact.gap"}),
        {.stability = true});
    ASSERT_TRUE(response.stability);
    EXPECT_EQ(response.stability->status, circulatory < 8000.0 ? "stable" : "unstable");
  }
}

TEST(RotorScene, ReducedToAllItsModesIsTheWholeOne) {
  const Response whole = weighted_residual_response(rotor()),
                 reduced = weighted_residual_response(rotor({"structure.kept_modes=3"}));
  ASSERT_TRUE(reduced.converged) << reduced.status;
  EXPECT_LT((reduced.contacts.displacement - whole.contacts.displacement).norm(),
            1e-8 * whole.contacts.displacement.norm());
  const solvers::LinearStructure structure = make_structure(rotor({"structure.kept_modes=3"}));
  EXPECT_FALSE(solvers::is_symmetric(structure.damping));
  EXPECT_FALSE(solvers::is_symmetric(structure.stiffness));
}

TEST(RotorScene, TakesARigidStopAtAContactWithoutMass) {
  const Response response = weighted_residual_response(
      rotor({"contact.law=rigid", "time.functions=63", "time.quadrature_points=512"}, {"contact.stiffness"}));
  ASSERT_TRUE(response.converged) << response.status;
  EXPECT_GT(response.contacts.force.maxCoeff(), 10.0);
}

TEST(RotorScene, CheckAndRunDescribeIt) {
  EXPECT_NE(describe_scene(rotor()).find("4 degrees of freedom"), std::string::npos)
      << describe_scene(rotor());
  EXPECT_TRUE(analyse(rotor()).converged);
}

TEST(UnsymmetricScene, IsAnErrorUnlessMeantAndNeverForAMassOrAMode) {
  TemporaryFolder folder;
  write_chain(folder);
  folder.write("skew.mtx",
               "%%MatrixMarket matrix coordinate real general\n3 3 5\n1 1 9\n2 2 9\n3 3 9\n1 3 1\n3 1 -1\n");
  const auto error = [&](const std::string& text) {
    return details_of_error([&](const std::string& one) { load_scene(folder.write("case.toml", one)); },
                            text);
  };
  const std::string damped = with(chain_scene, "modal_damping = 0.01 ", "damping = \"skew.mtx\"");
  EXPECT_NE(error(damped).allowed.find("or say structure.unsymmetric = true"), std::string::npos);
  const std::string meant =
      with(damped, "contact_dofs = [2, 3]", "unsymmetric = true\ncontact_dofs = [2, 3]");
  EXPECT_TRUE(load_scene(folder.write("meant.toml", meant)).structure.matrices.unsymmetric);
  folder.write("gyroscopic.mtx",
               "%%MatrixMarket matrix coordinate real skew-symmetric\n3 3 2\n2 1 4\n3 2 4\n");
  const Eigen::MatrixXd gyroscopic(
      make_structure(load_scene(folder.write("gyroscopic.toml", with(meant, "skew.mtx", "gyroscopic.mtx"))))
          .damping);
  EXPECT_EQ(gyroscopic, -gyroscopic.transpose());
  EXPECT_EQ(gyroscopic(2, 1), 4.0);
  EXPECT_EQ(error(with(meant, "m.mtx", "skew.mtx")).key, "structure.mass");
  folder.write("weak.mtx",
               "%%MatrixMarket matrix coordinate real general\n3 3 4\n1 1 1\n2 2 -1\n3 3 1\n1 3 1\n");
  EXPECT_NE(error(with(meant, "k.mtx", "weak.mtx")).allowed.find("positive definite"), std::string::npos);
  const std::string mode = with(meant, "forced_response", "nonlinear_mode");
  EXPECT_EQ(error(mode).key, "structure.unsymmetric");
}

}  // namespace
