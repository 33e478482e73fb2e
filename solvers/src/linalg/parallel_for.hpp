#pragma once
#include <Eigen/Core>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace wavebalance::solvers {

/// Calls work(worker, index) for all indices 0..count-1 on `workers` threads, the caller's among them, which
/// take the indices in ascending order; a worker has one index at a time. Results are the same for any number
/// of workers if those of an index depend on it alone. If calls throw, the exception of the least index is
/// thrown again once all threads have ended; later indices may then be left out. Creating a thread takes some
/// ten microseconds.
template <class Work>
void parallel_for(int workers, Eigen::Index count, const Work& work) {
  std::atomic<Eigen::Index> next{0}, least_failed{std::numeric_limits<Eigen::Index>::max()};
  std::exception_ptr failure;
  std::mutex guard;
  const auto run = [&](int worker) {
    for (Eigen::Index index = next++; index < count && index < least_failed; index = next++) try {
        work(worker, index);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (index >= least_failed) continue;
        least_failed = index;
        failure = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> threads;
    for (int worker = 1; worker < workers && worker < count; ++worker) threads.emplace_back(run, worker);
    run(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace wavebalance::solvers
