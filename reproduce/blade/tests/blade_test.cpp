// What is measured of the blade's motions, and its results as the programs write them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "blade_motion.hpp"
#include "rotating_blade.hpp"
#include "wavebalance/report/record.hpp"
#include "wavebalance/reproduce/output.hpp"
#include "wavebalance/reproduce/scene_loader.hpp"

namespace wavebalance::blade {
namespace {

namespace fs = std::filesystem;

reproduce::Scene scene_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return reproduce::load_scene(fs::path(WAVEBALANCE_SCENES) / "blade" / name, overrides);
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
  point.amplitudes(0, 2) = 1.0;  // n^2 |a|^2: 4 beside 4
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
  EXPECT_TRUE(centred(contact.leading, 0.0, 0.125));
  EXPECT_FALSE(centred(contact.leading, 0.5, 0.125));
  EXPECT_TRUE(centred(contact.trailing, 0.5, 0.125));
  EXPECT_FALSE(centred({}, 0.0, 0.125));
  EXPECT_FALSE(centred({0.0, 0.125}, 0.0, 0.125));
}

TEST(Torsion, SecondModeOfTheBladeIsTorsionAndTheFirstIsNot) {
  const reproduce::ModeStudy study(scene_of("campbell.toml"));
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
  const reproduce::ModeStudy projected(scene, blade.at(speed));
  const reproduce::ModeStudy anew(scene_of("campbell.toml", {"structure.rotation_speed=1500.0"}));
  EXPECT_GT(anew.linear_frequency(), 1.1 * reproduce::ModeStudy(scene, blade.at(0.0)).linear_frequency());
  for (Eigen::Index mode = 0; mode < 4; ++mode) {
    // Both reductions come from above; the modes of the blade at rest serve the turning one nearly as well.
    const double ratio =
        std::sqrt(projected.mode().model().omega_squared[mode] / anew.mode().model().omega_squared[mode]);
    EXPECT_NEAR(ratio, 1.0, 1e-3) << mode;
  }
  EXPECT_THROW(RotatingBlade(scene_of("campbell.toml", {"structure.rotation_speed=10.0"})),
               std::invalid_argument);
}

class BladeResults : public testing::Test {
 protected:
  BladeResults() {
    std::string name = (fs::temp_directory_path() / "wavebalance_blade_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~BladeResults() override { fs::remove_all(folder_); }

  int run(const std::string& program) const {
    const std::string command =
        std::string(BLADE_PROGRAMS) + "/blade_" + program + " --output '" + folder_.string() + "'";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  report::Record record(const std::string& stem) const {
    const auto file = folder_ / "records" / (stem + ".json");
    return report::parse_record(reproduce::read_file(file), file);
  }
  reproduce::Table read(const std::string& file) const { return reproduce::read_csv(folder_ / file); }

  fs::path folder_;
};

TEST_F(BladeResults, CampbellDiagramStiffensWithSpeedAndWithEnergy) {
  ASSERT_EQ(run("campbell"), 0);
  for (const auto& claim : record("campbell").claims) EXPECT_TRUE(claim.holds) << claim.quote;
  const auto table = read("campbell.csv");
  EXPECT_NEAR(table.numbers("linear_Hz").front(), 570.0, 0.5);
  // Energy 1 is the linear mode at grazing.
  EXPECT_EQ(table.numbers("energy_1"), table.numbers("linear_Hz"));
  EXPECT_NEAR(table.numbers("energy_7").front() / 570.0, 1.1931, 0.003);
}

}  // namespace
}  // namespace wavebalance::blade
