#pragma once
#include <string>

#include "report/arguments.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Exit codes of the command.
enum ExitCode { solved = 0, bad_input = 2, not_converged = 3, interrupted = 128 };  // + number of the signal

/// Puts the analysis of the arguments into their changes, with the keys that it leaves out, which are named
/// on the standard error. Nothing without one. Throws SceneError.
void take_analysis(RunArguments& arguments);

/// The scene that the arguments name, with its changes. Throws SceneError, and std::invalid_argument that
/// says how to begin if there is no such file.
Scene given_scene(const RunArguments& arguments);

/// Solves a scene and writes its results. Returns solved, not_converged, or interrupted + signal after a
/// sweep that a signal ended, whose points are written. Throws SceneError, IoError and std::invalid_argument.
int run_scene(const RunArguments& arguments);

/// Validates a scene and prints what would be solved. Throws SceneError.
int check_scene(const RunArguments& arguments);

/// Writes `text` to the standard output. Throws IoError.
int print(const std::string& text);

/// Case 1 of Jones & Legrand 2014, which the help shows.
Scene example_scene();

}  // namespace wavebalance::app
