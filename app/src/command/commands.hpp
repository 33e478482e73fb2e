#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Exit codes of the command.
enum ExitCode { solved = 0, bad_input = 2, not_converged = 3 };

struct RunArguments {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> overrides;
  bool quiet = false;
};

/// Solves a scene and writes its results. Returns solved or not_converged; throws SceneError and IoError.
int run_scene(const RunArguments& arguments);

/// Validates a scene and says what would be solved. Throws SceneError.
int check_scene(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// Writes `text` to the standard output. Throws IoError.
int print(const std::string& text);

/// Case 1 of Jones & Legrand 2014, which the help shows.
Scene example_scene();

}  // namespace wavebalance::app
