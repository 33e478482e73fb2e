#pragma once
#include <csignal>

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

}  // namespace wavebalance::app
