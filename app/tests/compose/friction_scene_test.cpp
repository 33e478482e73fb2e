// Scenes with friction: read, written, refused with the key, and solved against event-driven exact motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"
#include "wavebalance/contact/linear_law.hpp"
#include "wavebalance/contact/no_contact.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::app {
namespace {

const std::filesystem::path scenes = std::filesystem::path(WAVEBALANCE_SCENES) / "friction";

Scene scene_of(const std::string& name) { return load_scene((scenes / name).string()); }

Scene changed(const std::string& name, std::vector<std::string> settings) {
  return load_scene((scenes / name).string(), settings);
}

SceneError::Details error(const std::string& name, const std::vector<std::string>& settings) {
  try {
    changed(name, settings);
  } catch (const SceneError& found) {
    return found.details();
  }
  ADD_FAILURE() << settings.front() << " was not refused";
  return {};
}

TEST(FrictionScene, OfASliderHasTheWorkAndTheSharesOfTheExactMotion) {
  const Record record = analyse(scene_of("slider.toml"));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "friction_work_J"), 16.12103657, 1e-4 * 16.12);
  const Table friction = *value_in<Table>(record.summary, "friction");
  ASSERT_EQ(friction.rows(), 1U);
  EXPECT_NEAR(friction.numbers("slip_fraction")[0], 0.711779414, 3e-3);
  EXPECT_EQ(friction.numbers("open_fraction")[0], 0.0);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "unstable_multipliers"), 0);
}

TEST(FrictionScene, OfAContactThatLiftsOffHasTheMotionOfTheExactOne) {
  const Record record = analyse(scene_of("lift_off.toml"));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "friction_work_J"), 0.08956782539, 1e-4 * 0.0896);
  const Table friction = *value_in<Table>(record.summary, "friction");
  EXPECT_NEAR(friction.numbers("open_fraction")[0], 0.651719143, 3e-3);
  EXPECT_NEAR(friction.numbers("stick_fraction")[0], 0.3296863, 3e-3);
  const auto x = record.contacts.where("contact", "2").numbers("displacement_m");
  EXPECT_NEAR(*std::max_element(x.begin(), x.end()), 0.7786937648, 1e-5);
  EXPECT_NEAR(*std::min_element(x.begin(), x.end()), -0.907916742, 1e-5);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  // |multiplier| 0.63913085 of the two largest.
  EXPECT_NEAR(std::hypot(value_of<double>(record.summary, "leading_multiplier_real"),
                         value_of<double>(record.summary, "leading_multiplier_imag")),
              0.63913085, 1e-4);
}

TEST(FrictionScene, OfABoltedBeamIsSweptThroughItsResonance) {
  const Record record =
      analyse(changed("bolted_beam.toml", {"analysis.largest_step=3", "analysis.frequency_from=138",
                                           "analysis.frequency_to=146"}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(record.status, "reached_end");
}

// With grazing events to follow, as other laws of few samples have them, the sweep is lost near its
// beginning.
TEST(FrictionScene, OfASliderThatBeginsToSlipIsSweptToTheEndByLongSteps) {
  const Record record =
      analyse(changed("slider.toml", {"analysis.type=frequency_sweep", "analysis.frequency_from=0.05",
                                      "analysis.frequency_to=0.4", "forcing.amplitude=1.25",
                                      "contact.tangential_stiffness=25.0", "structure.stiffness_damping=0.04",
                                      "time.quadrature_points=512"}));
  EXPECT_TRUE(record.converged) << record.status;
}

TEST(FrictionScene, IsWrittenAndReadBackEqual) {
  for (const char* name : {"slider.toml", "lift_off.toml", "bolted_beam.toml"}) {
    const Scene scene = scene_of(name);
    EXPECT_EQ(parse_scene(write_scene(scene), (scenes / "written.toml").string()), scene) << name;
    EXPECT_EQ(complete_scene(scene), scene) << name;
  }
}

TEST(FrictionScene, WithoutFrictionIsThatOfItsNormalLaw) {
  const Record rubbing = analyse(changed("lift_off.toml", {"contact.friction=0"}));
  const Scene scene = changed("lift_off.toml", {"contact.friction=0"});
  solvers::CondensedProblem problem = make_problem(scene);
  problem.set_frequency(scene.forcing.frequency);
  const solvers::ContactLaws alone(
      {contact::LinearLaw(21.0, -0.6 / 21.0), solvers::AnyContactLaw(contact::NoContact())});
  solvers::ForcedResponseOptions options;
  options.form = solvers::ContactForm::displacement;
  const auto response = solvers::forced_response(problem, alone, options);
  ASSERT_TRUE(rubbing.converged && response.converged());
  const double largest = response.displacement.segment(problem.points(), problem.points()).maxCoeff();
  const auto x = rubbing.contacts.where("contact", "2").numbers("displacement_m");
  EXPECT_NEAR(*std::max_element(x.begin(), x.end()), largest, 1e-9 * largest);
  EXPECT_EQ(value_of<double>(rubbing.summary, "friction_work_J"), 0.0);
}

TEST(FrictionScene, ThatNeverSlipsSaysThatHistoryDecides) {
  const Record record = analyse(changed("slider.toml", {"contact.normal_load=1000"}));
  ASSERT_TRUE(record.converged);
  EXPECT_EQ(value_of<double>(record.summary, "friction_work_J"), 0.0);
  ASSERT_EQ(record.warnings.size(), 1U);
  EXPECT_NE(record.warnings[0].find("neither slips nor opens"), std::string::npos) << record.warnings[0];
}

TEST(FrictionScene, WithWrongKeysNamesTheKeyTheValueAndWhatIsAllowed) {
  struct Case {
    const char *scene, *setting, *key, *expected;
  };
  for (const Case& one : {
           Case{"slider.toml", "contact.friction=-0.1", "contact.friction", ">= 0"},
           Case{"slider.toml", "contact.tangential_stiffness=0", "contact.tangential_stiffness", "> 0"},
           Case{"slider.toml", "contact.normal_load=-1", "contact.normal_load", ">= 0"},
           Case{"slider.toml", "contact.normal_load=0", "contact.normal_load", "> 0"},
           Case{"slider.toml", "contact.normal_stiffness=5", "contact.normal_stiffness", "expected 0"},
           Case{"lift_off.toml", "contact.normal_stiffness=0", "normal_stiffness", "> 0"},
           Case{"lift_off.toml", "contact.law=linear", "contact.friction", ""},
           Case{"slider.toml", "analysis.type=motions", "analysis.type", "forced_response"},
           Case{"slider.toml", "analysis.phases=true", "analysis.phases", "false"},
           Case{"slider.toml", "contact.form=force", "contact.form", "displacement"},
       }) {
    const SceneError::Details details = error(one.scene, {one.setting});
    const std::string all = details.key + " " + details.allowed;
    EXPECT_NE(details.key.find(one.key), std::string::npos) << one.setting << ": " << details.key;
    EXPECT_NE(all.find(one.expected), std::string::npos) << one.setting << ": " << all;
  }
}

}  // namespace
}  // namespace wavebalance::app
