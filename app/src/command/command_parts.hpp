#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "command/interrupt_guard.hpp"
#include "command/progress_bar.hpp"
#include "report/run_report.hpp"
#include "wavebalance/app/compose/structure_model.hpp"

/// Common parts of commands.
namespace wavebalance::app {

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

}  // namespace wavebalance::app
