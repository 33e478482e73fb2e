#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace wavebalance::solvers {

/// `threads`, or one per core if it is 0. Throws std::invalid_argument if it is negative.
inline int thread_count(int threads) {
  if (threads < 0)
    throw std::invalid_argument("threads is " + std::to_string(threads) +
                                "; it must be at least 1, or 0 for one per core");
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace detail {

/// Indices 0..count-1 for threads, in ascending order until the work of one throws.
class SharedIndices {
 public:
  explicit SharedIndices(Eigen::Index count) : count_(count) {}

  template <class Work>
  void take(int worker, const Work& work) {
    for (Eigen::Index index = next_++; index < count_ && index < least_failed_; index = next_++) try {
        work(worker, index);
      } catch (...) {
        const std::lock_guard lock(guard_);
        if (index >= least_failed_) continue;
        least_failed_ = index;
        failure_ = std::current_exception();
      }
  }
  /// Throws the exception of the least index that failed, once all threads have ended.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const Eigen::Index count_;
  std::atomic<Eigen::Index> next_{0}, least_failed_{std::numeric_limits<Eigen::Index>::max()};
  std::exception_ptr failure_;
  std::mutex guard_;
};

/// Threads that can be waited for with a look around from time to time. Its end waits for them, too.
class WatchedThreads {
 public:
  template <class Work>
  void start(const Work& work) {
    {
      const std::lock_guard lock(guard_);
      ++working_;
    }
    threads_.emplace_back([this, work] {
      work();
      const std::lock_guard lock(guard_);
      if (--working_ == 0) ended_.notify_one();
    });
  }
  template <class Watch>
  void wait(const Watch& watch) {
    constexpr std::chrono::milliseconds interval{50};
    std::unique_lock lock(guard_);
    while (!ended_.wait_for(lock, interval, [this] { return working_ == 0; })) {
      lock.unlock();
      watch();
      lock.lock();
    }
  }

 private:
  std::mutex guard_;
  std::condition_variable ended_;
  int working_ = 0;
  std::vector<std::jthread> threads_;  // ends first
};

}  // namespace detail

/// Calls work(worker, index) for all indices 0..count-1 on `workers` threads, the caller's among them, in
/// ascending order of the indices; a worker has one index at a time. Results are the same for any number of
/// workers if the result of an index depends only on it. While the caller's thread has no index left and
/// others still work, it calls watch() about twenty times per second. If calls throw, the exception of the
/// least index is thrown again once all threads have ended, an exception of watch() before it; later
/// indices may then be left out. Creating a thread takes some ten microseconds.
template <class Work, class Watch>
void parallel_for(int workers, Eigen::Index count, const Work& work, const Watch& watch) {
  detail::SharedIndices indices(count);
  {
    detail::WatchedThreads threads;
    for (int worker = 1; worker < workers && worker < count; ++worker)
      threads.start([&, worker] { indices.take(worker, work); });
    indices.take(0, work);
    threads.wait(watch);
  }
  indices.rethrow();
}

/// The same without watch().
template <class Work>
void parallel_for(int workers, Eigen::Index count, const Work& work) {
  parallel_for(workers, count, work, [] {});
}

}  // namespace wavebalance::solvers
