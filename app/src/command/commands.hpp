#pragma once
#include <csignal>

#include "report/arguments.hpp"
#include "report/reports.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"

/// Common parts of commands.
namespace wavebalance::app {

/// While it lives, SIGINT, SIGTERM and SIGHUP end the program with status 128 + signal (130 for Ctrl-C), or,
/// if the first is to be noted, only the second does. A signal that the parent process ignores (nohup) stays
/// ignored. There can be one guard at a time.
class InterruptGuard {
 public:
  explicit InterruptGuard(bool note_first);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// The number of the signal that was noted, or 0.
  int signal() const;
  /// From now on signals wait until the guard ends.
  void defer();
  /// Ends the program as a second signal does. No file may have been begun.
  [[noreturn]] void end_program() const;

 private:
  sigset_t watched_;
  sigset_t previous_;
};

/// Shows progress on standard error: one line that is overwritten on a terminal, a line at intervals
/// elsewhere. Work that is done within half a second shows nothing.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Clears the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool visible_ = false;
  Clock::time_point next_;
};

/// Throws std::invalid_argument where no folder of results is named.
void require_output(const std::filesystem::path& output);
/// "summary.json, report.html", what a command has written, but for the frames of a motion.
std::string names_of(const std::vector<RecordFile>& files);
/// Says on the standard error what warnings a record has, and why it has no picture, if it has none.
void say_warnings(const std::vector<std::string>& warnings);
void say_no_picture(const std::string& reason);

/// Does `work` with an observer that shows progress, unless `quiet`, and stops it after a signal. Ends the
/// program if that was before anything was solved.
template <class Work>
auto until_signal(const InterruptGuard& guard, bool quiet, const Work& work) {
  ProgressBar bar;
  try {
    return work([&](const Progress& progress) {
      if (!quiet) bar.show(progress);
      return guard.signal() == 0;
    });
  } catch (const ReductionCancelled&) {
    bar.finish();
    guard.end_program();
  }
}

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

/// A way on for a scene that was not solved: in words, and as the change of keys that the words name. Words
/// that name no key have an empty change.
struct NextStep {
  std::string text;
  SceneChange change;
};

/// Remedies for a scene whose analysis ended with `status`, the most promising first. Each is a change that
/// the rules of scenes accept; empty if none is known.
std::vector<NextStep> next_steps(const Scene& scene, const std::string& status);

/// The statuses for which there are steps at all; for tests of each of them.
std::vector<std::string> statuses_with_next_steps(AnalysisType type);

}  // namespace wavebalance::app
