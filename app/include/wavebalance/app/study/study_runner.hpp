#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "wavebalance/app/study/messenger.hpp"
#include "wavebalance/app/study/study_row.hpp"

namespace wavebalance::app {

/// Takes rows in the order in which they end, called by one thread.
using RowSink = std::function<void(const StudyRow&)>;

struct StudyOptions {
  int threads = 0;  ///< that solve runs in this process; 0: one per core, or with a messenger one
  Messenger* messenger = nullptr;  ///< to processes that solve runs, too
  /// After which a process counts as dead, above 1 s. All send a message each second.
  std::chrono::milliseconds longest_silence{10'000};

  /// Throws std::invalid_argument.
  void validate() const;
};

/// How a study ran.
struct StudyOutcome {
  bool stopped = false;     ///< by the observer
  std::int64_t solved = 0;  ///< runs, each once
  int workers = 1;          ///< threads that solved runs, of all processes
  int lost = 0;  ///< processes that ended or fell silent; what they had not returned was solved by others
  double wall_seconds = 0.0;
};

/// Solves the runs `todo` and hands each row to `sink` once. Work is distributed as it is finished, so that
/// all workers end within the time of one run. The observer is called by this thread; once it returns
/// false, runs under way are dropped. Rows do not depend on the number of workers, but for their seconds.
/// What `sink` throws ends the study. With a messenger this is the part of process 0.
StudyOutcome run_study(const Study& study, const StudyRuns& runs, const std::vector<std::int64_t>& todo,
                       const StudyOptions& options, const RowSink& sink,
                       const solvers::Observer& observer = {});

/// The part of all other processes: solves what process 0 sends until that ends the study or falls silent.
/// options.messenger is not used.
void serve_study(const Study& study, const StudyRuns& runs, Messenger& messenger,
                 const StudyOptions& options);

}  // namespace wavebalance::app
