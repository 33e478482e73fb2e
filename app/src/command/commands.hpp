#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/arguments.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Exit codes of the command.
enum ExitCode { solved = 0, bad_input = 2, not_converged = 3, interrupted = 128 };  // + number of the signal

/// Puts the analysis of the arguments into their changes, with the keys that it leaves out, which are named
/// on the standard error. Nothing without one. Throws SceneError.
void take_analysis(RunArguments& arguments);

/// The scene that the arguments name, with its changes. Throws SceneError, and std::invalid_argument with a
/// hint how to begin if there is no such file.
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

/// Compares pairs of bases on a scene and writes the results. Returns as run_scene(): solved, not_converged
/// without a reference or a curve, interrupted + signal with what was measured so far. Throws as run_scene().
int compare_scene(const CompareArguments& arguments);

/// Solves a scene over values of its keys, from where an earlier start stopped, and writes the results. Below
/// mpirun this is the part of one process. Returns solved, not_converged if a run did not, or interrupted +
/// signal with the runs so far. Throws SceneError, IoError, std::invalid_argument and std::runtime_error.
int solve_study(const StudyArguments& arguments);

struct OverlayArguments {
  std::vector<std::filesystem::path> folders;  ///< results of earlier runs
  std::filesystem::path output;
  std::string quantity;  ///< see read_overlay()
  bool quiet = false;
};

/// Draws the curves of earlier results over each other and writes picture, page and data. Returns solved.
/// Throws SceneError, IoError and std::invalid_argument.
int overlay_results(const OverlayArguments& arguments);

/// The keys that every one of `filters` selects, as describe_scene_keys() writes them. A filter is a section
/// ("contact"), a key ("gap" or "contact.gap"), or a choice ("structure.type=matrices"), which leaves out the
/// keys that a scene of this choice may not hold. Throws std::invalid_argument for any other filter, and if
/// no key is left.
std::string selected_keys_text(const std::vector<std::string>& filters);

/// A line per key: "section.key" and the texts that it may be, for the completion of a shell.
std::string key_names_text();

struct InitArguments {
  std::string kind = "bar";      ///< one of starter_kinds()
  std::filesystem::path output;  ///< the scene; empty: <kind>.toml in the current folder
};

/// "bar", "matrices", "blade", "study".
std::vector<std::string> starter_kinds();

/// Writes a commented scene, or a study, to start from, with the files that it reads, whose names begin
/// with the stem of the output, and prints the next steps. Returns solved. Throws std::invalid_argument,
/// also if one of the files exists, and IoError.
int init_scene(const InitArguments& arguments);

struct ConvertArguments {
  std::vector<std::filesystem::path> files;  ///< of matrices, loads and at most one dof map
  std::filesystem::path output;              ///< folder
};

/// Writes the content of files of other codes as Matrix Market files and a dof map for scenes, and lists
/// them. Returns solved. Throws fem::MatrixFileError, std::invalid_argument if a file exists, IoError.
int convert_files(const ConvertArguments& arguments);

}  // namespace wavebalance::app
