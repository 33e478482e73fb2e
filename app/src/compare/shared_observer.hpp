#pragma once
#include <mutex>
#include <string>

#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::app {

/// An observer that several threads share: it is called by one at a time, and once it has returned false or
/// thrown an exception, never again. The observer must outlive this object.
class SharedObserver {
 public:
  explicit SharedObserver(const solvers::Observer& observer) : observer_(observer) {}
  SharedObserver(const SharedObserver&) = delete;
  SharedObserver& operator=(const SharedObserver&) = delete;

  bool goes_on(const solvers::Progress& progress) {
    const std::lock_guard alone(guard_);
    if (stopped_) return false;
    phase_ = progress.phase;
    stopped_ = true;  // if it throws
    stopped_ = !solvers::goes_on(observer_, progress);
    return !stopped_;
  }
  /// As if the observer had returned false.
  void stop() {
    const std::lock_guard alone(guard_);
    stopped_ = true;
  }
  bool stopped() const {
    const std::lock_guard alone(guard_);
    return stopped_;
  }
  /// The phase of the last call.
  std::string phase() const {
    const std::lock_guard alone(guard_);
    return phase_;
  }

 private:
  const solvers::Observer& observer_;
  mutable std::mutex guard_;
  bool stopped_ = false;
  std::string phase_;
};

}  // namespace wavebalance::app
