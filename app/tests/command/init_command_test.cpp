#include "command/init_command.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "command/keys_command.hpp"
#include "command/next_steps.hpp"
#include "support/command.hpp"
#include "support/summary_value.hpp"
#include "temporary_folder.hpp"
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
  const std::vector<std::string> expected{"dofs", "coefficients", "side", "law",  "stiffness", "gap",
                                          "law",  "stiffness",    "gap",  "form", "mass"};
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

/// The words "section.name" of a text.
std::vector<std::string> keys_in(const std::string& text) {
  std::vector<std::string> keys;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    word = word.substr(word.find_first_not_of('('));
    while (!word.empty() && std::string(",).").find(word.back()) != std::string::npos) word.pop_back();
    if (word.find('.') != std::string::npos && word[0] != '"') keys.push_back(word);
  }
  return keys;
}

TEST(NextSteps, NameKeysThatExist) {
  int advised = 0;
  for (const auto type :
       {AnalysisType::forced_response, AnalysisType::frequency_sweep, AnalysisType::nonlinear_mode,
        AnalysisType::time_stepping, AnalysisType::shooting, AnalysisType::motions})
    for (const char* status : {"stalled",
                               "iteration_limit",
                               "effort_limit",
                               "inaccurate",
                               "singular",
                               "unbalanced",
                               "size_limit",
                               "stagnated",
                               "not_converged",
                               "returned",
                               "no_start",
                               "closed",
                               "lost",
                               "unbounded",
                               "point_limit",
                               "cycling",
                               "ended at frequency ratio 1.2",
                               "subharmonic",
                               "step_failure",
                               "not_settled",
                               "not_solved",
                               "no_modes"})
      for (const bool exact : {false, true})
        for (const std::string& key : keys_in(next_step(type, status, exact))) {
          ++advised;
          EXPECT_TRUE(key == "forcing.terms" || find_scene_key(key) != nullptr) << key;
        }
  EXPECT_GT(advised, 20);
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
