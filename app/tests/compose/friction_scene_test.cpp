// Scenes with friction: read, written, refused with the key, and solved against event-driven exact motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "support/scene_error.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"
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
  // All of the structure is the mass of 1 kg at the contact.
  double energy = 0.0;
  for (const double velocity : record.response.numbers("velocity_m_per_s"))
    energy = std::max(energy, 0.5 * velocity * velocity);
  EXPECT_NEAR(value_of<double>(record.summary, "equivalent_damping_ratio"),
              16.12103657 / (4.0 * std::numbers::pi * energy), 1e-4);
}

// As published for the damped mode of one mass, k = kt = limit = 1: the damping ratio 0.0464 at a turning
// point of 1.2. Friction takes 4 (1.2 - 1) in a cycle.
TEST(FrictionScene, HasTheDampingRatioThatItsModeHasNearby) {
  const Record record =
      analyse(changed("slider.toml", {"structure.stiffness_damping=1e-9", "forcing.frequency=0.2188006",
                                      "forcing.amplitude=0.2122", "analysis.output_points=4096"}));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 1.2, 0.05);
  EXPECT_NEAR(value_of<double>(record.summary, "equivalent_damping_ratio"), 0.0464, 0.003);
}

TEST(FrictionScene, TakesItsDirectionsByTheNamesOfNodes) {
  const TemporaryFolder folder;
  const std::string map = folder.write("two.dof", "7.1\n7.2\n").string();
  std::string text = read_file(scenes / "lift_off.toml");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"dofs = [2]                          #",
                                            "dofs = [\"node 7 y\"] #"},
        {"tangent = [1]", "tangent = [\"node 7 x\"]"},
        {"damping = \"two_dampers.mtx\"", "damping = \"two_dampers.mtx\"\ndof_map = \"" + map + "\""}})
    text.replace(text.find(from), from.size(), to);
  const Scene scene = parse_scene(text, (scenes / "lift_off.toml").string());
  EXPECT_EQ(scene.contact.pairs.front().dofs, std::vector<int>{2});
  EXPECT_EQ(scene.contact.pairs.front().tangent, std::vector<int>{1});
  text.replace(text.find("tangent = [\"node 7 x\"]"), 22, "tangent = [\"node 8 x\"]");
  try {
    parse_scene(text, (scenes / "lift_off.toml").string());
    ADD_FAILURE() << "node 8 was not refused";
  } catch (const SceneError& found) {
    EXPECT_NE(found.details().key.find("tangent"), std::string::npos);
    EXPECT_NE(found.details().allowed.find("node 8 is not in"), std::string::npos);
  }
}

TEST(FrictionScene, OfAContactThatLiftsOffHasTheMotionOfTheExactOne) {
  const Record record = analyse(scene_of("lift_off.toml"));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "friction_work_J"), 0.08956782539, 1e-4 * 0.0896);
  const Table friction = *value_in<Table>(record.summary, "friction");
  EXPECT_NEAR(friction.numbers("open_fraction")[0], 0.651719143, 3e-3);
  EXPECT_NEAR(friction.numbers("stick_fraction")[0], 0.3296863, 3e-3);
  const auto x = record.contacts.where("direction", "tangent").numbers("displacement_m");
  EXPECT_NEAR(*std::max_element(x.begin(), x.end()), 0.7786937648, 1e-5);
  EXPECT_NEAR(*std::min_element(x.begin(), x.end()), -0.907916742, 1e-5);
  EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  // |multiplier| 0.63913085 of the two largest.
  EXPECT_NEAR(std::hypot(value_of<double>(record.summary, "leading_multiplier_real"),
                         value_of<double>(record.summary, "leading_multiplier_imag")),
              0.63913085, 1e-4);
}

// Against event-driven exact motions.
TEST(FrictionScene, SaysHowFarItsResponseIsFromTheMotionOfTheStructureAndItsPhases) {
  const Record record = analyse(scene_of("lift_off.toml"));
  EXPECT_EQ(value_of<std::string>(record.summary, "phases_status"), "converged");
  EXPECT_EQ(value_of<std::string>(record.summary, "stability_by"), "phases");
  const double displacement = value_of<double>(record.summary, "error_of_displacement"),
               force = value_of<double>(record.summary, "error_of_force");
  EXPECT_GT(displacement, 1e-7);
  EXPECT_LT(displacement, 2e-5);
  EXPECT_LT(force, 1e-4);
  EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_real"), 0.46568686, 1e-8);
  EXPECT_NEAR(value_of<double>(record.summary, "leading_multiplier_imag"), 0.43774878, 1e-8);
  const Table phases = *value_in<Table>(record.summary, "phases");
  ASSERT_EQ(phases.rows(), 3U);
  EXPECT_EQ(phases.where("state", "slip").numbers("contact")[0], 1.0);
  EXPECT_NEAR(phases.where("state", "slip").numbers("begin")[0], 0.280840393, 1e-9);
  EXPECT_NEAR(phases.where("state", "open").numbers("begin")[0], 0.299434949, 1e-9);
  EXPECT_NEAR(phases.where("state", "stick").numbers("begin")[0], 0.951154093, 1e-9);
}

// The text of a scene without its balance, and with other lines after [contact].
std::string without_balance(const std::string& name, const std::string& contact = {}) {
  std::ifstream file(scenes / name);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t time = text.find("[time]"), after = text.find("[analysis]");
  text.erase(time, after - time);
  if (!contact.empty()) text.insert(text.find("[forcing]"), contact);
  return text;
}

TEST(FrictionScene, ByPhasesHasTheWorkAndTheSharesOfTheExactMotion) {
  const std::string text = without_balance("lift_off.toml");
  for (const char* how : {"time.method=phases", "time.tolerance=1e-9", "analysis.type=shooting"}) {
    const Record record =
        analyse(parse_scene(text, (scenes / "by_phases.toml").string(), std::vector<std::string>{how}));
    ASSERT_TRUE(record.converged) << how << ' ' << record.status;
    EXPECT_EQ(value_of<std::string>(record.summary, "solved_by"), "phases") << how;
    EXPECT_NEAR(value_of<double>(record.summary, "friction_work_J"), 0.08956782539, 1e-9 * 0.0896) << how;
    const Table friction = *value_in<Table>(record.summary, "friction");
    EXPECT_NEAR(friction.numbers("open_fraction")[0], 0.651719143, 1e-8);
    EXPECT_NEAR(friction.numbers("stick_fraction")[0], 0.3296863, 1e-8);
    EXPECT_EQ(value_of<std::string>(record.summary, "stability"), "stable");
  }
}

TEST(FrictionScene, ByPhasesTakesOtherLawsBeside) {
  const auto refused = [](const std::string& name, const std::string& contact) {
    try {
      parse_scene(without_balance(name, contact), (scenes / "by_phases.toml").string(),
                  std::vector<std::string>{"time.method=phases"});
    } catch (const SceneError& found) {
      return found.details().key + " " + found.details().allowed + " " + found.what();
    }
    return std::string("not refused");
  };
  const std::string mixed = refused(
      "lift_off.toml", "[[contact.pairs]]\ndofs = [1]\nlaw = \"linear\"\nstiffness = 5.0\ngap = 1.0\n");
  EXPECT_EQ(mixed, "not refused");
}

// Steps that are measured by the slip at the start of the sweep take a thousand points.
TEST(FrictionScene, OfABoltedBeamIsSweptThroughItsResonanceInFewPoints) {
  const Record record = analyse(changed("bolted_beam.toml", {"analysis.stability=false"}));
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_EQ(record.status, "reached_end");
  EXPECT_LE(value_of<std::int64_t>(record.summary, "points"), 100);
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
  for (const char* name : {"slider.toml", "lift_off.toml", "bolted_beam.toml", "bolted_beam_mode.toml"}) {
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
  const auto x = rubbing.contacts.where("direction", "tangent").numbers("displacement_m");
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

// m = k = k_t = 1 and a limit of 1: exact motions have omega 1.225867690198, xi / (2 omega) 0.105752880426
// where the mass turns back at 2; the damping of the structure adds 0.05 / (2 omega).
TEST(FrictionScene, OfAModeHasFrequencyAndDampingOverAmplitude) {
  const std::vector<std::string> mode{"analysis.type=nonlinear_mode", "analysis.points=40",
                                      "structure.stiffness_damping=0"};
  const Record record = analyse(changed("slider.toml", mode));
  ASSERT_TRUE(record.converged) << record.status;
  EXPECT_NEAR(value_of<double>(record.summary, "slip_amplitude_m"), 1.0, 1e-8);
  EXPECT_NEAR(value_of<double>(record.summary, "linear_frequency_Hz"), std::sqrt(2.0) / 6.283185307179586,
              1e-9);
  // Between 2 and 3 the exact damping ratio is 0.1103178 at most.
  EXPECT_NEAR(value_of<double>(record.summary, "largest_damping_ratio"), 0.1110, 2e-3);
  EXPECT_GT(record.backbone.rows(), 30U);
  EXPECT_EQ(record.figure.panels.size(), 2U);
  std::vector<std::string> one = mode;
  one.push_back("analysis.amplitude_ratio=2.000767809");
  const Record motion = analyse(changed("slider.toml", one));
  ASSERT_TRUE(motion.converged) << motion.status;
  EXPECT_NEAR(value_of<double>(motion.summary, "damping_ratio"), 0.105752880426, 1e-5);
  EXPECT_NEAR(value_of<double>(motion.summary, "frequency_Hz"), 1.225867690198 / 6.283185307179586, 1e-6);
  EXPECT_NEAR(value_of<double>(motion.summary, "max_displacement_m"), 2.0, 1e-3);
  EXPECT_NEAR(value_of<double>(motion.summary, "friction_work_J"), 4.0, 1e-3);  // 4 L (X - L / k_t)
  EXPECT_FALSE(motion.response.empty());
}

TEST(FrictionScene, OfAModeWithLiftOffStartsAtItsStaticState) {
  const Record record =
      analyse(changed("lift_off.toml", {"analysis.type=nonlinear_mode", "analysis.points=40"}));
  ASSERT_TRUE(record.converged) << record.status;
  const std::vector<double> open = record.backbone.numbers("open_fraction");
  EXPECT_EQ(open.front(), 0.0);
  EXPECT_GT(open.back(), 0.3);
  EXPECT_EQ(record.backbone.numbers("friction_work_J").front(), 0.0);
}

TEST(FrictionScene, WithWrongKeysNamesTheKeyTheValueAndWhatIsAllowed) {
  struct Case {
    const char *scene, *setting, *key, *expected;
  };
  for (const Case& one : {
           Case{"slider.toml", "contact.friction=-0.1", "contact.friction", "in 0..1000"},
           Case{"slider.toml", "contact.tangential_stiffness=0", "contact.tangential_stiffness", "> 0"},
           Case{"slider.toml", "contact.normal_load=-1", "contact.normal_load", ">= 0"},
           Case{"slider.toml", "contact.normal_load=0", "contact.normal_load", "> 0"},
           Case{"slider.toml", "contact.normal_stiffness=5", "contact.normal_stiffness", "expected 0"},
           Case{"lift_off.toml", "contact.normal_stiffness=0", "normal_stiffness", "> 0"},
           Case{"lift_off.toml", "contact.law=linear", "contact.friction", ""},
           Case{"slider.toml", "contact.tangential_stiffness=inf", "contact.tangential_stiffness", "> 0"},
       }) {
    const SceneError::Details details = error(one.scene, {one.setting});
    const std::string all = details.key + " " + details.allowed;
    EXPECT_NE(details.key.find(one.key), std::string::npos) << one.setting << ": " << details.key;
    EXPECT_NE(all.find(one.expected), std::string::npos) << one.setting << ": " << all;
  }
}

TEST(FrictionScene, NeedsALoadWhereNoNormalDirectionGivesTheLimit) {
  const std::vector<std::string> none, removed{"contact.normal_load"};
  try {
    load_scene((scenes / "slider.toml").string(), none, removed);
    ADD_FAILURE() << "a slider without a limit was not refused";
  } catch (const SceneError& found) {
    EXPECT_EQ(found.details().key, "contact.normal_load");
  }
  EXPECT_NO_THROW(load_scene((scenes / "lift_off.toml").string(), none, removed));
}

// Two beams glued at the joint and two that slide there bound the frequency; both have hardly any damping.
TEST(FrictionScene, OfTheModeOfABoltedBeamHasItsDampingFromTheJoint) {
  const Record record =
      analyse(changed("bolted_beam_mode.toml", {"analysis.points=20", "analysis.largest_amplitude=4"}));
  ASSERT_TRUE(record.converged) << record.status;
  const std::vector<double> damping = record.backbone.numbers("damping_ratio");
  EXPECT_NEAR(damping.front(), value_of<double>(record.summary, "linear_damping_ratio"), 1e-6);
  EXPECT_GT(value_of<double>(record.summary, "largest_damping_ratio"), 0.05);
  EXPECT_LT(value_of<double>(record.summary, "least_frequency_ratio"), 0.95);
}

// The beams of ten contacts whose springs of 2e7 N/m are left out: the mass of the contacts goes to the
// beams, which give way there by springs of their own.
TEST(FrictionScene, WithoutTangentialStiffnessIsRigidAndMovesTheMassOfItsContacts) {
  const std::vector<std::string> settings{"analysis.type=forced_response", "forcing.frequency=145",
                                          "structure.kept_modes=30", "analysis.stability=false",
                                          "analysis.phases=false"};
  std::vector<std::string> sweeping{"analysis.frequency_from", "analysis.frequency_to", "analysis.first_step",
                                    "analysis.largest_step"};
  const auto at = [&](std::vector<std::string> removed) {
    removed.insert(removed.end(), sweeping.begin(), sweeping.end());
    return load_scene((scenes / "bolted_beam.toml").string(), settings, removed);
  };
  const Record rigid = analyse(at({"contact.tangential_stiffness"}));
  ASSERT_TRUE(rigid.converged) << rigid.status;
  EXPECT_EQ(value_of<std::string>(rigid.summary, "form"), "force");
  EXPECT_LT(value_of<double>(rigid.summary, "contact_mass_frequency_change"), 0.05);
  EXPECT_GT(value_of<double>(rigid.summary, "friction_work_J"), 0.0);
  const Record elastic = analyse(at({}));
  ASSERT_TRUE(elastic.converged) << elastic.status;
  EXPECT_EQ(value_of<std::string>(elastic.summary, "form"), "displacement");
  EXPECT_LT(value_of<double>(elastic.summary, "friction_energy_error"), 0.05);
}

TEST(FrictionScene, OfASweepHasWorkAndSharesAtEachPointAndItsFirstSlip) {
  const double omega = 1.2, exact = std::hypot(2.0 - omega * omega, 0.05 * omega);
  const Record record =
      analyse(changed("slider.toml", {"analysis.type=amplitude_sweep", "analysis.amplitude_from=0.2",
                                      "analysis.amplitude_to=2", "time.functions=31",
                                      "time.quadrature_points=256", "analysis.largest_step=0.1"}));
  ASSERT_TRUE(record.converged) << record.status;
  const std::vector<double> work = record.sweep.numbers("friction_work_J"),
                            slip = record.sweep.numbers("slip_fraction");
  EXPECT_EQ(work.front(), 0.0);
  EXPECT_NEAR(work.back(), 16.12103657, 1e-2);
  EXPECT_NEAR(slip.back(), 0.711779414, 1e-2);
  const Table points = *value_in<Table>(record.summary, "special_points");
  const Table slips = points.where("type", "slip");
  ASSERT_EQ(slips.rows(), 1U);
  EXPECT_NEAR(slips.numbers("amplitude_N")[0], exact, 1e-7 * exact);
}

TEST(FrictionScene, OfAModeWithWrongKeysNamesTheKey) {
  struct Case {
    const char *scene, *setting, *key, *expected;
  };
  for (const Case& one : {
           Case{"slider.toml", "analysis.cosine_only=true", "analysis.cosine_only", "false"},
           Case{"slider.toml", "analysis.energy_ratio=2", "analysis.energy_ratio", "amplitude_ratio"},
           Case{"slider.toml", "analysis.largest_energy=20", "analysis.largest_energy", "largest_amplitude"},
           Case{"slider.toml", "analysis.largest_amplitude=0.9", "analysis.largest_amplitude", "> 1"},
           Case{"slider.toml", "analysis.amplitude_ratio=-1", "analysis.amplitude_ratio", ">= 0"},
           Case{"slider.toml", "analysis.mode=2", "analysis.mode", "at most 1"},
       }) {
    try {
      changed(one.scene, {"analysis.type=nonlinear_mode", one.setting});
      ADD_FAILURE() << one.setting << " was not refused";
      continue;
    } catch (const SceneError& found) {
      const std::string all = found.details().key + " " + found.details().allowed;
      EXPECT_NE(found.details().key.find(one.key), std::string::npos) << one.setting << ": " << all;
      EXPECT_NE(all.find(one.expected), std::string::npos) << one.setting << ": " << all;
    }
  }
}

}  // namespace
}  // namespace wavebalance::app
