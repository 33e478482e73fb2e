#include "study/study_workers.hpp"

#include <algorithm>

namespace wavebalance::app {

StudyWorkers::StudyWorkers(const Study& study, const StudyRuns& runs, int threads)
    : study_(study), runs_(runs) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

StudyWorkers::~StudyWorkers() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  given_.notify_all();
}

void StudyWorkers::add(std::int64_t run) {
  ++pending_;
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(run);
  }
  given_.notify_one();
}

std::vector<StudyRow> StudyWorkers::finished(std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  done_.wait_for(lock, wait, [this] { return !rows_.empty(); });
  pending_ -= rows_.size();
  return std::exchange(rows_, {});
}

void StudyWorkers::work() {
  const solvers::Observer observer = [this](const solvers::Progress&) { return !stopped_; };
  LastStructure last;
  std::unique_lock lock(mutex_);
  for (;;) {
    given_.wait(lock, [this] { return stopped_ || !queue_.empty(); });
    if (stopped_) return;
    const std::int64_t run = queue_.front();
    queue_.pop_front();
    lock.unlock();
    StudyRow row = solve_run(study_, runs_, run, last, observer);
    lock.lock();
    if (stopped_) return;
    rows_.push_back(std::move(row));
    done_.notify_one();
  }
}

std::chrono::milliseconds look_interval(double mean_seconds) {
  constexpr double shortest = 1.0, longest = 20.0;  // ms
  return std::chrono::milliseconds(static_cast<int>(std::clamp(1e3 * mean_seconds, shortest, longest)));
}

int runs_ahead(double mean_seconds, bool few_left) {
  constexpr double short_run = 0.05;  // s
  return mean_seconds < short_run ? 4 : few_left ? 1 : 2;
}

}  // namespace wavebalance::app
