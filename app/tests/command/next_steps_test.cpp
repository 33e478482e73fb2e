#include "command/commands.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "temporary_folder.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

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
                    exact = "[time]\nmethod = \"exact\"\n", tolerance = "[time]\ntolerance = 1e-2\n",
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
  for (const std::string& time : {bases, std::string(), exact, tolerance})
    for (const std::string& one : analyses(time)) parts.push_back(one);
  for (const char* type : {"time_stepping", "motions"})
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
      continue;  // because not every analysis supports each law
    }
    ++scenes;
    std::set<std::string> tried;  // statuses share steps
    for (const std::string& status : statuses_with_next_steps(scene->analysis.type))
      for (const NextStep& step : next_steps(*scene, status)) {
        ++advised;
        if (!tried.insert(step.text).second) continue;
        EXPECT_NO_THROW(load_changed(folder, text, step.change)) << text << status << ": " << step.text;
        for (const std::string& set : step.change.set)
          EXPECT_TRUE(find_scene_key(set.substr(0, set.find('='))) != nullptr) << set;
      }
  }
  EXPECT_GT(scenes, 50);
  EXPECT_GT(advised, 500);
}

}  // namespace
}  // namespace wavebalance::app
