#pragma once
#include <csignal>
#include <thread>

#include "wavebalance/app/files/output.hpp"

namespace wavebalance::app {

/// While it lives, SIGINT, SIGTERM and SIGHUP remove what `files` has not committed and end the process with
/// status 128 + signal (130 for Ctrl-C). A thread waits for the signals, so that none strikes in the middle
/// of a commit. To be made before any other thread.
class InterruptGuard {
 public:
  explicit InterruptGuard(OutputFiles& files);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void wait_for_signals(OutputFiles& files) const;

  sigset_t watched_;
  sigset_t previous_;
  std::thread thread_;
};

}  // namespace wavebalance::app
