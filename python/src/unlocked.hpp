#pragma once
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::python {

/// While one lives, OpenBLAS has one thread, as in the command: its threads cost more than they give in
/// systems of a few hundred unknowns, and the digits of results would depend on them. NumPy has its threads
/// back afterwards.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// Takes the function that is called with the phase, step, value, measure and share done of long work, or
/// None, and returns the one before. With the lock.
pybind11::object exchange_progress(pybind11::object callback);
/// Calls it. False where it raised; Python's exception is then set. With the lock.
bool tell_progress(const solvers::Progress& progress);

/// Python's lock, released while this object lives, so that other threads of Python run during a solve.
class Unlocked {
 public:
  /// Stops long work on Ctrl-C: signals are handled about ten times per second, with the lock taken for
  /// that moment, and the function of exchange_progress() is called. Only the thread that made this object
  /// takes the lock, because Python handles signals only in its main thread; other threads that work for it
  /// call the observer, too, and never wait for the lock. This object must outlive the work.
  solvers::Observer observer() {
    return [this](const solvers::Progress& progress) { return goes_on(progress); };
  }
  /// Whether a signal or that function ended the work. Python's exception is then set.
  bool interrupted() const { return interrupted_; }

 private:
  bool goes_on(const solvers::Progress& progress) {
    if (interrupted_ || std::this_thread::get_id() != owner_) return !interrupted_;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return true;
    next_ = now + interval;
    const pybind11::gil_scoped_acquire locked;
    interrupted_ = PyErr_CheckSignals() != 0 || !tell_progress(progress);
    return !interrupted_;
  }

  static constexpr std::chrono::milliseconds interval{100};
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
  std::atomic<bool> interrupted_ = false;
  const std::thread::id owner_ = std::this_thread::get_id();
  pybind11::gil_scoped_release released_;
};

/// The result of work(observer), computed without Python's lock. Throws KeyboardInterrupt, or whatever else a
/// handler of signals raised, and what the work throws otherwise.
template <class Work>
auto unlocked(Work&& work) {
  std::optional<decltype(work(solvers::Observer()))> found;
  std::exception_ptr failure;
  bool interrupted = false;
  {
    Unlocked scope;
    const OneBlasThread one;
    try {
      found.emplace(work(scope.observer()));
    } catch (...) {
      failure = std::current_exception();
    }
    interrupted = scope.interrupted();
  }
  if (interrupted) throw pybind11::error_already_set();
  if (failure) std::rethrow_exception(failure);
  return std::move(*found);
}

}  // namespace wavebalance::python
