// Scenes of every contact law: read, written, refused and solved.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/scene_error.hpp"
#include "support/scene_texts.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"
#include "wavebalance/contact/catalogue.hpp"

namespace wavebalance::app {
namespace {

/// bar_scene with another [contact].
std::string scene_with(const std::string& contact) {
  std::string text = bar_scene;
  const auto begin = text.find("law = "), end = text.find("[forcing]");
  return text.replace(begin, end - begin, contact);
}

const std::string spring_table = "-2e-3,-4e5\n0,0\n3e-3,9e5\n";

/// A law and the force of its scene at u (m) and v (m/s).
struct LawCase {
  std::string contact;
  double u, v, force;
};

std::vector<LawCase> cases() {
  return {{"law = \"bilinear\"\nslopes = [1e7, -2e6]\ngap = 1e-3\n", 2e-3, 0.0, 8e3},
          {"law = \"cubic\"\ncubic_stiffness = -1e12\n", 1e-3, 0.0, -1e3},
          {"law = \"polynomial\"\npolynomial = [1e6, 0, 1e12]\n", -1e-3, 0.0, -2e3},
          {"law = \"clearance\"\nstiffness = 1e8\ngap = 1e-3\n", -1.5e-3, 0.0, -5e4},
          {"law = \"clearance\"\nstiffness = 1e8\ngap = 1e-3\ngap_below = 5e-4\nstiffness_below = 2e8\n",
           -1.5e-3, 0.0, -2e5},
          {"law = \"table\"\ntable = \"spring.csv\"\n", 3e-3, 0.0, 9e5},
          {"law = \"hunt_crossley\"\nhertz_stiffness = 1e9\npower = 2\ndissipation = 0.5\ngap = 1e-3\n", 2e-3,
           1.0, 1.5e3},
          {"law = \"kelvin_voigt\"\nstiffness = 1e8\ndamping = 1e4\ngap = 1e-3\n", 2e-3, -2.0, 8e4}};
}

class LawScene : public ::testing::Test {
 protected:
  LawScene() { folder_.write("spring.csv", spring_table); }
  Scene load(const std::string& text) { return parse_scene(text, (folder_ / "scene.toml").string()); }
  SceneError::Details error(const std::string& text) {
    return details_of_error([this](const std::string& one) { load(one); }, text);
  }
  TemporaryFolder folder_;
};

TEST_F(LawScene, HasTheForceOfItsFormula) {
  for (const LawCase& one : cases()) {
    const Scene scene = load(scene_with(one.contact));
    EXPECT_NEAR(make_law(scene.contact).force(one.u, one.v), one.force, 1e-9 * std::abs(one.force))
        << one.contact;
  }
}

TEST_F(LawScene, IsWrittenAndReadBackEqual) {
  for (const LawCase& one : cases()) {
    const Scene scene = load(scene_with(one.contact));
    const std::string written = write_scene(scene);
    EXPECT_EQ(parse_scene(written, (folder_ / "written.toml").string()), scene) << written;
    EXPECT_EQ(complete_scene(scene), scene) << written;
  }
}

TEST_F(LawScene, IsRefusedWithItsKeyAndWhatIsAllowed) {
  struct Refusal {
    std::string contact, key, allowed;
  };
  for (
      const auto& [contact, key, allowed] : std::vector<Refusal>{
          {"law = \"bilinear\"\nslopes = [1e7]\ngap = 1e-3\n", "contact.slopes",
           "a list of 2 numbers in N/m"},
          {"law = \"bilinear\"\ngap = 1e-3\n", "contact.slopes", "missing"},
          {"law = \"cubic\"\ncubic_stiffness = 0.0\n", "contact.cubic_stiffness", "finite and not zero"},
          {"law = \"cubic\"\ncubic_stiffness = 1.0\ngap = 1e-3\n", "contact.gap", "only with contact.law"},
          {"law = \"polynomial\"\npolynomial = [0.0]\n", "contact.polynomial", "not zero"},
          {"law = \"clearance\"\nstiffness = 1e8\ngap = -1e-3\n", "contact.gap", "at least 0"},
          {"law = \"clearance\"\nstiffness = 1e8\ngap = 1e-3\ngap_below = -1.0\n", "contact.gap_below",
           ">= 0"},
          {"law = \"table\"\ntable = \"none.csv\"\n", "contact.table", "cannot be read"},
          {"law = \"hunt_crossley\"\nhertz_stiffness = 1e9\npower = 0.5\ndissipation = 0.5\ngap = 1e-3\n",
           "contact.power", "in 1..10"},
          {"law = \"hunt_crossley\"\nhertz_stiffness = 1e9\ndissipation = 0.5\ngap = 1e-3\nform = \"force\"\n",
           "contact.form", "depends on the velocity"},
          {"law = \"kelvin_voigt\"\nstiffness = 1e8\ngap = 1e-3\n", "contact.damping", "missing"},
          {"law = \"linear\"\nstiffness = 1e8\ngap = 1e-3\ndamping = 1.0\n", "contact.damping",
           "only with contact.law = \"kelvin_voigt\""}}) {
    const auto found = error(scene_with(contact));
    EXPECT_EQ(found.key, key) << contact;
    EXPECT_NE(found.allowed.find(allowed), std::string::npos) << found.allowed;
  }
}

TEST_F(LawScene, NamesTheKeysOfItsLawWhereAKeyIsThatOfAnother) {
  const auto found = error(scene_with("law = \"linear\"\nstiffness = 1e8\ngap = 1e-3\nexponent = 50.0\n"));
  EXPECT_EQ(found.key, "contact.exponent");
  EXPECT_EQ(
      found.allowed,
      "does not belong to a scene with contact.law = \"linear\"; only with contact.law = \"exponential\"; the "
      "keys of this law are stiffness, gap");
}

/// The table of LAWS.md as the catalogue has it.
std::string laws_table() {
  std::string text = "| `law` | force, opposed to u | keys |\n| --- | --- | --- |\n";
  for (const contact::LawEntry& law : contact::law_catalogue()) {
    std::string keys;
    for (const contact::LawParameter& one : law.parameters)
      if (one.name != "tangents")  // which the directions of a contact say
        keys += (keys.empty() ? "`" : ", `") + std::string(one.name) + "`";
    text += fmt::format("| `\"{}\"` | {} | {} |\n", law.name, law.force, keys.empty() ? "none" : keys);
  }
  return text;
}

TEST(LawsDocument, HasTheTableOfTheCatalogue) {
  const auto file = std::filesystem::path(WAVEBALANCE_README).parent_path() / "app" / "LAWS.md";
  EXPECT_NE(read_file(file).find(laws_table()), std::string::npos) << "expected in LAWS.md:\n"
                                                                   << laws_table();
}

// A key of any law is set by the name of the catalogue, and only its law takes it.
TEST_F(LawScene, TakesOverridesOfTheParametersOfItsLaw) {
  const std::string clearance = scene_with("law = \"clearance\"\nstiffness = 1e8\ngap = 1e-3\n");
  const auto with_gap_below = parse_scene(clearance, (folder_ / "scene.toml").string(),
                                          std::vector<std::string>{"contact.gap_below=0"});
  EXPECT_EQ(with_gap_below.contact.number("gap_below"), 0.0);
  EXPECT_NE(write_scene(with_gap_below).find("gap_below = 0.0"), std::string::npos);
  EXPECT_EQ(load(clearance).contact.values.count("gap_below"), 0u);
}

TEST_F(LawScene, OfATableNamesFileAndLineOfWhatIsWrong) {
  folder_.write("spring.csv", "0,0\n1e-3,soft\n");
  const auto found = error(scene_with("law = \"table\"\ntable = \"spring.csv\"\n"));
  EXPECT_EQ(found.key, "contact.table");
  EXPECT_NE(found.allowed.find("spring.csv:2: \"1e-3,soft\""), std::string::npos) << found.allowed;
}

TEST_F(LawScene, OfADamperIsRefusedForHaarFunctions) {
  const std::string stop = cases()[6].contact;
  std::string haar = with(scene_with(stop), "trial = \"fourier\"", "trial = \"haar\"");
  const auto functions = error(haar);
  EXPECT_EQ(functions.key, "time.trial");
  EXPECT_NE(functions.allowed.find("\"hunt_crossley\""), std::string::npos) << functions.allowed;
  EXPECT_NE(functions.allowed.find("\"haar\""), std::string::npos) << functions.allowed;
}

TEST_F(LawScene, IsSolvedAndARecordOfADamperSaysWhatItDissipates) {
  for (const LawCase& one : cases()) {
    const Record record = analyse(load(with(scene_with(one.contact), "functions = 64", "functions = 31")));
    EXPECT_TRUE(record.converged) << one.contact << record.status;
    const bool damped =
        one.contact.find("hunt") != std::string::npos || one.contact.find("kelvin") != std::string::npos;
    const bool named = find_entry(record.summary, "contact_dissipation_J") != nullptr;
    EXPECT_EQ(named, damped) << one.contact;
    if (damped) {
      EXPECT_GT(value_of<double>(record.summary, "contact_dissipation_J"), 0.0);
    }
  }
}

Record law_example(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return analyse(load_scene(std::filesystem::path(WAVEBALANCE_SCENES) / "laws" / name, overrides));
}

// The peak of Duffing's oscillator lies on its backbone, w^2 = 1 + 3/4 k3 a^2, where c w a = F.
TEST(LawExample, DuffingsOscillatorHasItsPeakAndTwoFolds) {
  const Record record = law_example("duffing.toml");
  EXPECT_TRUE(record.converged) << record.status;
  const double w = std::sqrt(0.5 + std::sqrt(0.25 + 0.75 * 0.5 * 0.01 / (0.04 * 0.04)));
  EXPECT_NEAR(value_of<double>(record.summary, "max_displacement_m"), 0.1 / (0.04 * w),
              0.02 * 0.1 / (0.04 * w));
  EXPECT_TRUE(record.figure.panels.at(0).segments.empty());  // no gap is drawn where the law has none
}

TEST(LawExample, BacklashTouchesBothSides) {
  const Record record = law_example("backlash.toml");
  EXPECT_TRUE(record.converged) << record.status;
  EXPECT_GT(value_of<double>(record.summary, "max_displacement_m"), 0.5);
  EXPECT_LT(value_of<double>(record.summary, "min_displacement_m"), -0.8);
  EXPECT_EQ(value_of<std::vector<double>>(record.summary, "turning_points_Hz").size(), 2u);
}

// The kinks of 256 samples turn the curve 60 times near its peak, at which the stability changes once.
TEST(LawExample, BacklashHasAFoldAtItsPeakAlsoWhereItsSamplesTurnTheCurve) {
  const Record record = law_example("backlash.toml", std::vector<std::string>{"time.quadrature_points=256"});
  const Table special = value_of<Table>(record.summary, "special_points");
  const std::vector<std::string> types = special.texts("type");
  EXPECT_EQ(std::count(types.begin(), types.end(), "branch"), 0);
  ASSERT_EQ(std::count(types.begin(), types.end(), "fold"), 2);
  const auto peak = std::find(types.begin(), types.end(), "fold") - types.begin();
  EXPECT_NEAR(special.numbers("frequency_Hz")[static_cast<std::size_t>(peak)], 0.3667, 1e-4);
}

TEST(LawExample, ARubberStopTakesMoreThanATenthOfTheWork) {
  const Record record = law_example("rubber_stop.toml");
  EXPECT_TRUE(record.converged) << record.status;
  const double rms = value_of<double>(record.summary, "rms_displacement_m");
  EXPECT_GT(value_of<double>(record.summary, "contact_dissipation_J"),
            0.1 * 0.1 * std::pow(2 * 3.14159 * 0.2 * rms, 2) * 5.0);
}

}  // namespace
}  // namespace wavebalance::app
