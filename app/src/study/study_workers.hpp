#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <thread>

#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {

/// Threads that solve the runs of a study given to them. All members may be called by one thread, which is
/// none of them.
class StudyWorkers {
 public:
  /// `study` and `runs` must outlive the object.
  StudyWorkers(const Study& study, const StudyRuns& runs, int threads);
  /// Stops the runs under way and waits for their threads.
  ~StudyWorkers();
  StudyWorkers(const StudyWorkers&) = delete;
  StudyWorkers& operator=(const StudyWorkers&) = delete;

  void add(std::int64_t run);
  /// Runs added whose rows finished() has not returned.
  std::size_t pending() const { return pending_; }
  int threads() const { return static_cast<int>(threads_.size()); }
  /// The rows since the last call, after `wait` at most if there are none yet.
  std::vector<StudyRow> finished(std::chrono::milliseconds wait);

 private:
  void work();

  const Study& study_;
  const StudyRuns& runs_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable given_, done_;
  std::deque<std::int64_t> queue_;
  std::vector<StudyRow> rows_;
  std::size_t pending_ = 0;
  std::vector<std::jthread> threads_;
};

/// How often the thread that hands out runs looks for messages of other processes: about once per run, so
/// that looking costs next to nothing.
std::chrono::milliseconds look_interval(double mean_seconds);

/// How many runs a worker thread of another process is given before the first of them has ended, so that it
/// does not wait for the next one: more where runs are as short as the interval between looks, and one
/// where few are left, so that no run waits while a worker is idle.
int runs_ahead(double mean_seconds, bool few_left);

}  // namespace wavebalance::app
