#include "command/init_command.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "command/keys_command.hpp"
#include "command/next_steps.hpp"
#include "support/command.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compose/other_analysis.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

TEST(CommandInit, EverySceneThatItWritesIsSolvedAsItIs) {
  for (const std::string& kind : starter_kinds()) {
    if (kind == "study") continue;
    const TemporaryFolder folder;
    const std::string scene = (folder / "mine.toml").string();
    const Outcome written = run(folder, {"init", kind, "--output", scene});
    EXPECT_EQ(written.exit_code, 0) << written.errors;
    EXPECT_NE(written.output.find("wavebalance run " + scene), std::string::npos) << written.output;
    const Outcome solved = run(folder, {"run", scene, "--output", folder / "out"});
    EXPECT_EQ(solved.exit_code, 0) << kind << ": " << solved.errors;
    EXPECT_NE(read_file(folder / "out/summary.json").find("\"converged\": true"), std::string::npos);
    EXPECT_EQ(read_file(folder / "out/summary.json").find("\"contact_fraction\": 0.0"), std::string::npos)
        << kind;
  }
}

TEST(CommandInit, TheBeamOfMatricesHasTheFirstFrequencyOfAnEulerBernoulliCantilever) {
  const TemporaryFolder folder;
  run(folder, {"init", "matrices", "--output", folder / "beam.toml"});
  // (1.8751 / l)^2 / (2 pi) sqrt(E h^2 / (12 rho)) = 16.77 Hz
  EXPECT_NE(run(folder, {"check", folder / "beam.toml"}).output.find("16.7"), std::string::npos);
}

TEST(CommandInit, OverwritesNothingAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  folder.write("mine_mass.mtx", "precious");
  const Outcome outcome = run(folder, {"init", "matrices", "--output", folder / "mine.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("mine_mass.mtx exists and is not overwritten"), std::string::npos)
      << outcome.errors;
  EXPECT_EQ(read_file(folder / "mine_mass.mtx"), "precious");
  EXPECT_FALSE(std::filesystem::exists(folder / "mine.toml"));
}

TEST(CommandInit, WrongNamesAreAnsweredWithWhatIsAllowed) {
  const TemporaryFolder folder;
  EXPECT_EQ(run(folder, {"init", "matrixes"}).errors,
            "wavebalance: init matrixes: there are bar, matrices, blade, study; did you mean matrices?\n");
  const Outcome outcome = run(folder, {"init", "--output", folder / "scene.txt"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("expected the name of a file that ends in .toml"), std::string::npos);
}

TEST(CommandInit, StudyIsOneThatRuns) {
  const TemporaryFolder folder;
  const Outcome written = run(folder, {"init", "study", "--output", folder / "map.toml"});
  EXPECT_EQ(written.exit_code, 0) << written.errors;
  EXPECT_NE(written.output.find("next:    wavebalance study "), std::string::npos) << written.output;
  const Outcome solved = run(folder, {"study", folder / "map.toml", "--output", folder / "map"});
  EXPECT_EQ(solved.exit_code, 0) << solved.errors << solved.output;
  EXPECT_NE(solved.output.find("117 of 117 runs have ended, and 117 of them converged."), std::string::npos);
}

TEST(CommandInit, WritesTheSceneOfReadme) {
  const std::string readme = read_file(WAVEBALANCE_README);
  EXPECT_NE(readme.find("```toml\n" + starter_scene("bar", "bar").front().contents + "```"),
            std::string::npos);
}

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line[2] != ' ') names.push_back(line.substr(2));
  return names;
}

TEST(CommandKeys, OfASectionAreThoseAlone) {
  const std::string forcing = selected_keys_text({"forcing"});
  EXPECT_TRUE(forcing.starts_with("[[forcing.terms]]"));
  EXPECT_NE(forcing.find("\n[forcing]\n"), std::string::npos);
  EXPECT_EQ(forcing.find("[time]"), std::string::npos);
  EXPECT_TRUE(selected_keys_text({"time"}).starts_with("[time]\n"));
}

TEST(CommandKeys, OfAChoiceLeaveOutWhatSuchASceneMayNotHold) {
  const auto names = names_in(selected_keys_text({"structure", "structure.type=matrices"}));
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_TRUE(has("mass"));
  EXPECT_TRUE(has("type"));
  EXPECT_TRUE(has("stiffness_damping"));
  EXPECT_FALSE(has("youngs_modulus"));
  EXPECT_FALSE(has("elements"));
}

TEST(CommandKeys, OfALawAreItsOwnParametersAsItHasThem) {
  const std::string text = selected_keys_text({"contact", "contact.law=linear"});
  const std::vector<std::string> expected{"dofs", "coefficients", "side",      "law", "name", "stiffness",
                                          "gap",  "law",          "stiffness", "gap", "form", "mass"};
  EXPECT_EQ(names_in(text), expected);
  EXPECT_NE(text.find("slope of the linear law.\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("clearance law"), std::string::npos) << text;
}

TEST(CommandKeys, TangentsAreThoseOfALawWithFriction) {
  const auto names = names_in(selected_keys_text({"contact", "contact.law=coulomb"}));
  for (const char* name :
       {"tangent", "tangent_coefficients", "second_tangent", "second_tangent_coefficients", "friction"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

TEST(CommandKeys, OfANameAreAllOfThisName) {
  EXPECT_EQ(names_in(selected_keys_text({"gap"})), (std::vector<std::string>{"gap", "gap"}));
  EXPECT_EQ(names_in(selected_keys_text({"contact.gap"})), std::vector<std::string>{"gap"});
}

TEST(CommandKeys, OfSeveralSectionsAreAllListed) {
  const std::string three = selected_keys_text({"forcing", "analysis", "time"});
  for (const char* section : {"[forcing]", "[analysis]", "[time]"})
    EXPECT_NE(three.find(section), std::string::npos) << section;
  EXPECT_EQ(three.find("[structure]"), std::string::npos);
  EXPECT_EQ(names_in(selected_keys_text({"contact.gap", "forcing.frequency"})),
            (std::vector<std::string>{"gap", "frequency"}));
}

TEST(CommandKeys, WithoutAFilterAreAll) { EXPECT_EQ(selected_keys_text({}), describe_scene_keys()); }

void expect_refused(const std::vector<std::string>& filters, const std::string& part) {
  try {
    selected_keys_text(filters);
    ADD_FAILURE() << "expected a refusal with " << part;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(CommandKeys, WrongFiltersAreAnsweredWithWhatIsAllowed) {
  expect_refused({"contcat"}, "did you mean contact?");
  expect_refused({"structure.type=matrix"}, "structure.type may be \"bar\", \"blade\" or \"matrices\"");
  expect_refused({"contact.gap=1"}, "expected one of structure.type");
  expect_refused({"structure.area", "structure.type=matrices"}, "such a scene has none of these");
}

TEST(CommandKeys, NamesAreOnePerLineWithTheirChoices) {
  const std::string names = key_names_text();
  EXPECT_NE(names.find("\ncontact.gap\n"), std::string::npos);
  EXPECT_NE(names.find("\nstructure.free true false\n"), std::string::npos);
  EXPECT_EQ(std::count(names.begin(), names.end(), '\n'), static_cast<long>(scene_keys().size()));
}

/// A scene of two masses for each contact law and analysis that goes with it.
std::vector<std::string> scenes_of_laws_and_analyses() {
  const std::vector<std::string> laws{
      "law = \"none\"",
      "law = \"exponential\"\nconstant = 1.0\nexponent = 1e3\ngap = 1e-3",
      "law = \"linear\"\nstiffness = 1e4\ngap = 1e-3",
      "law = \"rigid\"\ngap = 1e-3",
      "law = \"rigid\"\nrestitution = 0.7\ngap = 1e-3",
      "law = \"clearance\"\nstiffness = 1e4\ngap = 1e-3",
      "law = \"kelvin_voigt\"\nstiffness = 1e4\ndamping = 1.0\ngap = 1e-3",
      "law = \"hunt_crossley\"\nstiffness = 1e6\nexponent = 1.5\nrestitution = 0.8\ngap = 1e-3",
      "law = \"coulomb\"\nfriction = 0.3\nnormal_load = 3.0\ntangential_stiffness = 1e4",
      "law = \"coulomb\"\nfriction = 0.3\nnormal_load = 3.0"};
  const std::string bases = "[time]\ntrial = \"fourier\"\nweight = \"fourier\"\nfunctions = 32\n",
                    phases = "[time]\nmethod = \"phases\"\n", tolerance = "[time]\ntolerance = 1e-2\n",
                    load = "[forcing]\nload_dofs = [1]\n", amplitude = "amplitude = 5.0\n",
                    frequency = "frequency = 3.0\n";
  const std::string sweep = "type = \"frequency_sweep\"\nfrequency_from = 3.0\nfrequency_to = 6.0\n";
  const auto analyses = [&](const std::string& time) {
    return std::vector<std::string>{
        load + amplitude + frequency + time + "[analysis]\n",
        load + amplitude + time + "[analysis]\n" + sweep,
        load + amplitude + time + "[analysis]\n" + sweep + "exact = true\n",
        load + "amplitude = 1.0\n" + frequency + time +
            "[analysis]\ntype = \"amplitude_sweep\"\namplitude_from = 1.0\namplitude_to = 2.0\n"};
  };
  std::vector<std::string> scenes, parts{"[analysis]\ntype = \"nonlinear_mode\"\n"};
  for (const std::string& time : {bases, std::string(), phases, tolerance})
    for (const std::string& one : analyses(time)) parts.push_back(one);
  for (const char* type : {"time_stepping", "shooting", "motions"})
    parts.push_back(load + amplitude + frequency + "[analysis]\ntype = \"" + type + "\"\n");
  for (const std::string& law : laws)
    for (const std::string& part : parts)
      scenes.push_back(
          "[structure]\ntype = \"matrices\"\nmass = \"m.mtx\"\nstiffness = \"k.mtx\"\ncontact_dofs = [2]\n"
          "[contact]\n" +
          law + "\n" + part);
  return scenes;
}

/// Loads the scene of a file with a change as a user makes it, by options and by lines at the file's end.
void load_changed(const TemporaryFolder& folder, const std::string& text, const SceneChange& change) {
  const auto file = folder.write("changed.toml", text + "\n" + change.added + "\n");
  std::vector<std::string> set = change.set, removed;
  if (!change.analysis.empty()) removed = keys_beside_analysis(file, change.analysis, set);
  if (!change.analysis.empty()) set.push_back("analysis.type=" + change.analysis);
  for (const std::string& key : change.unset)
    if (text.find("\n" + key.substr(key.find('.') + 1) + " = ") != std::string::npos) removed.push_back(key);
  load_scene(file, set, removed);
}

TEST(NextSteps, OfEveryStatusAnalysisAndLawAreAcceptedByTheScene) {
  const TemporaryFolder folder;
  const std::string header = "%%MatrixMarket matrix coordinate real general\n2 2 ";
  folder.write("m.mtx", header + "2\n1 1 1.0\n2 2 0.5\n");
  folder.write("k.mtx", header + "4\n1 1 2e3\n1 2 -1e3\n2 1 -1e3\n2 2 1e3\n");
  int scenes = 0, advised = 0;
  for (const std::string& text : scenes_of_laws_and_analyses()) {
    const auto file = folder.write("scene.toml", text);
    std::optional<Scene> scene;
    try {
      scene = load_scene(file);
    } catch (const SceneError&) {
      continue;  // as an analysis does not take each law
    }
    ++scenes;
    for (const std::string& status : statuses_with_next_steps(scene->analysis.type))
      for (const NextStep& step : next_steps(*scene, status)) {
        ++advised;
        EXPECT_NO_THROW(load_changed(folder, text, step.change)) << text << status << ": " << step.text;
        for (const std::string& set : step.change.set)
          EXPECT_TRUE(find_scene_key(set.substr(0, set.find('='))) != nullptr) << set;
      }
  }
  EXPECT_GT(scenes, 50);
  EXPECT_GT(advised, 500);
}

TEST(NextSteps, AreSaidWhereARunDoesNotConverge) {
  const TemporaryFolder folder;
  run(folder, {"init", "matrices", "--output", folder / "beam.toml"});
  const Outcome outcome = run(
      folder, {"run", folder / "beam.toml", "--output", folder / "out", "--set", "analysis.max_points=3"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.errors.find("what may help: a larger analysis.max_points"), std::string::npos)
      << outcome.errors;
}

}  // namespace
}  // namespace wavebalance::app
