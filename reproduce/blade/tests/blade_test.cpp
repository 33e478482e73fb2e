// Measures of the blade's motions, and its models.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "blade_motion.hpp"
#include "forced_blade.hpp"
#include "rotating_blade.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::blade {
namespace {

namespace fs = std::filesystem;

app::Scene scene_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return app::load_scene(fs::path(WAVEBALANCE_SCENES) / "blade" / name, overrides);
}

TEST(TipMotion, OfARigidMotionIsThatMotion) {
  const fem::Blade blade = fem::blade();
  const Eigen::Vector2d centre =
      blade.model.mesh.nodes(Eigen::all, blade.contact_nodes).topRows(2).rowwise().mean();
  const double rotation = 1e-3;
  const Eigen::Vector2d translation(2e-4, -3e-4);
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, blade.model.mesh.nodes.cols());
  for (Eigen::Index node = 0; node < u.cols(); ++node) {
    const Eigen::Vector2d arm = blade.model.mesh.nodes.col(node).head<2>() - centre;
    u.col(node) << translation.x() - rotation * arm.y(), translation.y() + rotation * arm.x(), 0.5;
  }
  const TipMotion found = tip_motion(blade, u);
  EXPECT_LT((found.translation - translation).norm(), 1e-16);
  EXPECT_NEAR(found.rotation, rotation, 1e-15);
  const double rotated = std::pow(rotation * found.radius, 2);
  EXPECT_NEAR(found.rotation_share(), rotated / (rotated + translation.squaredNorm()), 1e-13);
}

TEST(TorsionShare, IsOneInATorsionModeAndCountsHarmonicsByTheirSquare) {
  solvers::ModePoint point;
  point.amplitudes = Eigen::MatrixXcd::Zero(2, 3);
  point.amplitudes(1, 1) = {0.0, 2.0};
  EXPECT_EQ(torsion_share({false, true}, point), 1.0);
  EXPECT_EQ(torsion_share({true, false}, point), 0.0);
  point.amplitudes(0, 2) = 1.0;  // n^2 |a|^2: 4 and 4
  point.amplitudes(0, 0) = 7.0;  // a static displacement has no kinetic energy
  EXPECT_DOUBLE_EQ(torsion_share({false, true}, point), 0.5);
}

TEST(EdgeContact, TellsTheHalvesOfTheChordApart) {
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(4, 8);
  force(0, 0) = force(1, 7) = force(1, 1) = 1.0;
  force(3, 4) = 1.0;
  const EdgeContact contact = edge_contact(force);
  EXPECT_EQ(contact.leading, (std::vector<double>{0.0, 0.125, 0.875}));
  EXPECT_EQ(contact.trailing, std::vector<double>{0.5});
}

TEST(Torsion, SecondModeOfTheBladeIsTorsionAndTheFirstIsNot) {
  const app::ModeStudy study(scene_of("campbell.toml"));
  const auto torsion = torsion_modes(study);
  EXPECT_FALSE(torsion[0]);
  EXPECT_TRUE(torsion[1]);
  EXPECT_FALSE(torsion[2]);
  EXPECT_TRUE(torsion[3]);
}

TEST(RotatingBlade, ReducedAtRestHasTheFrequenciesOfTheOneReducedAtSpeed) {
  const auto scene = scene_of("campbell.toml");
  const RotatingBlade blade(scene);
  const double speed = 1500.0;  // rad/s, beyond the diagram's
  const app::ModeStudy projected(scene, blade.at(speed));
  const app::ModeStudy anew(scene_of("campbell.toml", {"structure.rotation_speed=1500.0"}));
  EXPECT_GT(anew.linear_frequency(), 1.1 * app::ModeStudy(scene, blade.at(0.0)).linear_frequency());
  for (Eigen::Index mode = 0; mode < 4; ++mode) {
    // Both reductions come from above; the modes of the blade at rest serve the turning one nearly as well.
    const double ratio =
        std::sqrt(projected.mode().model().omega_squared[mode] / anew.mode().model().omega_squared[mode]);
    EXPECT_NEAR(ratio, 1.0, 1e-3) << mode;
  }
  EXPECT_THROW(RotatingBlade(scene_of("campbell.toml", {"structure.rotation_speed=10.0"})),
               std::invalid_argument);
}

TEST(RmsDifference, ComparesCommonTimes) {
  Eigen::MatrixXd fine(1, 4), coarse(1, 2);
  fine << 3.0, 100.0, 4.0, -100.0;
  coarse << 3.0, 9.0;
  EXPECT_DOUBLE_EQ(rms_difference(coarse, fine), 1.0);  // |0, 5| / |3, 4|
  EXPECT_EQ(rms_difference(fine, fine), 0.0);
  EXPECT_THROW(rms_difference(fine, Eigen::MatrixXd(1, 3)), std::invalid_argument);
  EXPECT_THROW(rms_difference(fine, Eigen::MatrixXd(2, 4)), std::invalid_argument);
}

TEST(SteppedResponses, KeepTheBranchTheyComeFrom) {
  const std::vector<std::string> overrides{"time.functions=16", "time.quadrature_points=32",
                                           "analysis.frequency_to=690.0", "analysis.largest_step=20.0"};
  const auto scene = scene_of("forced_response.toml", overrides);
  const auto model = app::make_model(scene);
  const auto up = stepped_sweep(scene, model), down = stepped_sweep(reversed(scene), model);
  ASSERT_EQ(up.size(), 9u);
  ASSERT_EQ(down.size(), 9u);
  const double gap = scene.contact.gap, tolerance = 1e-6 * gap;
  for (const auto& response : up) {
    EXPECT_TRUE(response.converged) << response.frequency;
    const auto& other = at(down, response.frequency);
    // Stiffening: upwards the response is never the smaller one, and the force belongs to the springs.
    EXPECT_GE(response.displacement.maxCoeff(), other.displacement.maxCoeff() - tolerance);
    const Eigen::MatrixXd penetration = (response.displacement.array() - gap).cwiseMax(0.0);
    EXPECT_LT((response.force - scene.contact.number("stiffness") * penetration).cwiseAbs().maxCoeff(),
              1e-9 * (1.0 + response.force.maxCoeff()));
  }
  EXPECT_GT(at(up, 630.0).displacement.maxCoeff(), 2.0 * at(down, 630.0).displacement.maxCoeff());
  EXPECT_THROW(at(up, 400.0), std::out_of_range);
}

}  // namespace
}  // namespace wavebalance::blade
