// Scenes with impacts: read, written, refused with the key, and solved against published motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compare/comparison.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

const std::filesystem::path impact_scenes = std::filesystem::path(WAVEBALANCE_SCENES) / "impacts";

Scene impact_scene(const std::string& name, std::vector<std::string> settings = {}) {
  return load_scene((impact_scenes / name).string(), std::move(settings));
}

SceneError::Details refusal_of(const std::string& name, const std::vector<std::string>& settings) {
  try {
    impact_scene(name, settings);
  } catch (const SceneError& found) {
    return found.details();
  }
  ADD_FAILURE() << settings.front() << " was not refused";
  return {};
}

Table file_of(const Record& record, const std::string& name) {
  for (const RecordFile& file : record.files)
    if (file.name == name) {
      const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("impact_scene_" + name);
      std::ofstream(path) << file.contents;
      return read_csv(path);
    }
  ADD_FAILURE() << "no " << name;
  return {};
}

// Recipes for Continuation, example 15.2.
TEST(ImpactScene, OfTheOscillatorOfCocoHasItsMotion) {
  const Record record = analyse(impact_scene("oscillator.toml"));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<std::string>(record.summary, "solved_by"), "impacts");
  EXPECT_EQ(value_of<double>(record.summary, "impacts"), 1.0);
  EXPECT_NEAR(value_of<double>(record.summary, "max_impact_velocity_m_per_s"), 1.69573294, 1e-8);
  EXPECT_NEAR(value_of<double>(record.summary, "max_impulse_Ns"), 3.05231929, 1e-8);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_real"), -0.58429531, 1e-7);
  const Table impacts = file_of(record, "impacts.csv");
  ASSERT_EQ(impacts.rows(), 1U);
  EXPECT_NEAR(impacts.numbers("time_fraction")[0], 0.0120881625, 1e-9);
  EXPECT_NEAR(impacts.numbers("velocity_after_m_per_s")[0], -1.35658635, 1e-8);
}

TEST(ImpactScene, LosesAsMuchEnergyAsTheLoadBringsBesideTheDamping) {
  for (const char* name : {"oscillator.toml", "bar_with_end_mass.toml"}) {
    const Scene scene = impact_scene(name, {"structure.stiffness_damping=1e-9"});
    const Record record = analyse(scene);
    if (!record.converged) continue;
    // Work of the load at its degree of freedom, the contact, over the period by its exact velocity.
    const Response response = impacts_response(scene, make_model(scene), {});
    constexpr int points = 200000;
    const Eigen::VectorXd times =
        (Eigen::VectorXd::LinSpaced(points, 0.0, points - 1.0).array() + 0.5).matrix() / points;
    const Eigen::MatrixXd velocity = response.impacts->motion.velocity(times);
    double work = 0.0;
    const int periods = response.impacts->load_periods;
    for (int k = 0; k < points; ++k)
      work += scene.forcing.amplitude * std::cos(2.0 * 3.14159265358979323846 * periods * times[k]) *
              velocity(0, k) / (points * scene.forcing.frequency);
    const double lost = value_of<double>(record.summary, "impact_energy_J");
    EXPECT_NEAR(work, lost, 1e-3 * lost) << name;
  }
}

TEST(ImpactScene, OfABarHasImpactsAndAMotionOfAllItsNodes) {
  const Record record = analyse(impact_scene("bar_with_end_mass.toml"));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_EQ(value_of<double>(record.summary, "impacts"), 2.0);
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 0.8, 1e-13);
  EXPECT_NEAR(value_of<double>(record.summary, "max_impact_velocity_m_per_s"), 1.8136127872, 1e-9);
  EXPECT_LE(value_of<double>(record.summary, "structure_left_out"), 1e-4);
  const auto written = [](const RecordFile& file) { return file.name == "motion.mtx"; };
  EXPECT_EQ(std::count_if(record.files.begin(), record.files.end(), written), 1);
}

TEST(ImpactScene, OfABarWhoseEndHasTheMassOfAnElementComesToRestAfterManyImpacts) {
  const std::vector<std::string> set{"contact.restitution=0.8"},
      unset{"structure.massless_tip", "time.trial",       "time.weight",
            "time.functions",         "time.formulation", "time.quadrature_points",
            "time.inner_products"};
  const Record record = analyse(
      load_scene(impact_scenes.parent_path() / "jones_legrand_2014" / "case2_rigid.toml", set, unset));
  EXPECT_EQ(record.status, "converged");
  EXPECT_GT(value_of<double>(record.summary, "impacts"), 20.0);
  EXPECT_FALSE(value_in<Table>(record.summary, "lasting_contacts")->empty());
}

TEST(ImpactScene, OfABarWithoutReboundHasContactThatLasts) {
  const Record record = analyse(impact_scene("bar_without_rebound.toml"));
  ASSERT_TRUE(record.converged) << record.status;
  const Table lasting = *value_in<Table>(record.summary, "lasting_contacts");
  EXPECT_EQ(lasting.rows(), 1U);
  EXPECT_GT(lasting.numbers("end")[0], lasting.numbers("begin")[0] + 0.05);
  EXPECT_GT(value_of<double>(record.summary, "max_contact_force_N"), 0.0);
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 14.5e-3, 1e-12);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  const auto force = record.response.numbers("contact_force_N");
  EXPECT_GE(*std::min_element(force.begin(), force.end()), 0.0);
}

TEST(ImpactScene, IsSweptThroughGrazingWithStopsOfDifferentRestitution) {
  const Record record = analyse(impact_scene("between_stops.toml"));
  EXPECT_TRUE(record.converged) << record.status;
  const auto frequencies = record.sweep.numbers("frequency_Hz");
  EXPECT_EQ(frequencies.front(), 0.02);
  EXPECT_EQ(record.sweep.numbers("impacts").front(), 0.0);
  const Table special = *value_in<Table>(record.summary, "special_points");
  // 1 / |1 - w^2 + 0.1 w i| is the motion without contact, which reaches the gap of 1.2 there.
  const double grazing = special.where("type", "grazing").numbers("frequency_Hz").front();
  EXPECT_GT(grazing, 0.02);
  const double w = 2.0 * 3.14159265358979323846 * grazing;
  const double reach = 1.0 / std::hypot(1.0 - w * w, 0.1 * w);
  EXPECT_NEAR(reach, 1.2, 1e-9);
}

TEST(ImpactScene, HasAllMotionsOfOneFrequency) {
  const Record record =
      analyse(impact_scene("oscillator.toml", {"contact.gap=0", "structure.stiffness_damping=0.05",
                                               "forcing.frequency=0.5888732894", "analysis.type=motions",
                                               "analysis.random_starts=12"}));
  ASSERT_TRUE(record.converged) << record.status;
  const Table motions = *value_in<Table>(record.summary, "motions");
  EXPECT_GE(motions.rows(), 1U);
  double arrived = 0.0;
  for (const double share : motions.numbers("share")) arrived += share;
  EXPECT_NEAR(arrived + double(value_of<std::int64_t>(record.summary, "starts_without_motion")) / 12.0, 1.0,
              1e-12);
  EXPECT_GE(file_of(record, "motion_1_impacts.csv").rows(), 1U);
}

TEST(ImpactScene, OfTimeSteppingHasTheMotionOfNewtonsMethod) {
  const Record solved = analyse(impact_scene("oscillator.toml")),
               stepped = analyse(impact_scene("oscillator.toml",
                                              {"analysis.type=time_stepping", "analysis.tolerance=1e-9"}));
  ASSERT_TRUE(stepped.converged) << stepped.status;
  EXPECT_NEAR(value_of<double>(stepped.summary, "max_impulse_Ns"),
              value_of<double>(solved.summary, "max_impulse_Ns"), 1e-7);
  EXPECT_GT(value_of<std::int64_t>(stepped.summary, "iterations"), 10);
}

TEST(ImpactScene, IsWrittenAndReadBackEqual) {
  for (const char* name :
       {"oscillator.toml", "bar_with_end_mass.toml", "bar_without_rebound.toml", "between_stops.toml"}) {
    const Scene scene = impact_scene(name);
    EXPECT_EQ(parse_scene(write_scene(scene), (impact_scenes / "written.toml").string()), scene) << name;
    EXPECT_EQ(complete_scene(scene), scene) << name;
  }
}

TEST(ImpactScene, WithWrongKeysNamesTheKeyTheValueAndWhatIsAllowed) {
  struct Case {
    const char *scene, *setting, *key, *expected;
  };
  for (const Case& one : {
           Case{"oscillator.toml", "contact.restitution=1.5", "contact.restitution", "0..1"},
           Case{"oscillator.toml", "contact.restitution=-0.1", "contact.restitution", "0..1"},
           Case{"oscillator.toml", "contact.law=linear", "contact.restitution", "rigid"},
           Case{"oscillator.toml", "contact.mass=redistribute", "contact.mass", "one or the other"},
           Case{"oscillator.toml", "time.functions=63", "time.functions", "restitution"},
           Case{"oscillator.toml", "time.method=phases", "time.method", "restitution"},
           Case{"oscillator.toml", "analysis.phases=true", "analysis.phases", "restitution"},
           Case{"between_stops.toml", "analysis.exact=true", "analysis.exact", "false"},
           Case{"between_stops.toml", "analysis.motion_at=peak", "analysis.motion_at", "none"},
           Case{"oscillator.toml", "structure.loss_factor=0.1", "structure.loss_factor", "0"},
       }) {
    const SceneError::Details details = refusal_of(one.scene, {one.setting});
    EXPECT_NE(details.key.find(one.key), std::string::npos) << one.setting << ": " << details.key;
    EXPECT_NE((details.key + " " + details.allowed).find(one.expected), std::string::npos)
        << one.setting << ": " << details.allowed;
  }
}

TEST(ImpactScene, HasNoFunctionsToCompare) {
  try {
    check_comparison(impact_scene("oscillator.toml"), {});
    ADD_FAILURE() << "it was not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("contact.restitution"), std::string::npos) << error.what();
  }
}

TEST(ImpactScene, OfANonlinearModeIsRefused) {
  const SceneError::Details details =
      refusal_of("oscillator.toml", {"analysis.type=nonlinear_mode", "structure.stiffness_damping=0"});
  EXPECT_EQ(details.key, "analysis.type");
  EXPECT_NE(details.allowed.find("free motion"), std::string::npos) << details.allowed;
}

TEST(ImpactScene, WithMassAndNeitherRestitutionNorRedistributionNamesBoth) {
  const std::vector<std::string> set{"contact.mass=keep", "time.trial=fourier", "time.weight=fourier",
                                     "time.functions=15"},
      unset{"contact.restitution"};
  try {
    load_scene(impact_scenes / "oscillator.toml", set, unset);
    ADD_FAILURE() << "it was not refused";
  } catch (const SceneError& found) {
    EXPECT_NE(found.details().allowed.find("restitution"), std::string::npos) << found.details().allowed;
    EXPECT_NE(found.details().allowed.find("redistribute"), std::string::npos);
  }
}

}  // namespace
}  // namespace wavebalance::app
