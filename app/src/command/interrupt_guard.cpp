#include "command/interrupt_guard.hpp"

#include <pthread.h>
#include <unistd.h>

#include <cstdio>

namespace wavebalance::app {
namespace {

constexpr int end_of_watch = SIGUSR2;

/// A signal that the parent told us to ignore (nohup, background jobs) stays ignored.
void add_unless_ignored(sigset_t& set, int signal) {
  struct sigaction current {};
  ::sigaction(signal, nullptr, &current);
  if (current.sa_handler != SIG_IGN) ::sigaddset(&set, signal);
}

}  // namespace

InterruptGuard::InterruptGuard(OutputFiles& files) {
  ::sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) add_unless_ignored(watched_, signal);
  ::sigaddset(&watched_, end_of_watch);
  ::pthread_sigmask(SIG_BLOCK, &watched_, &previous_);
  thread_ = std::thread([this, &files] { wait_for_signals(files); });
}

InterruptGuard::~InterruptGuard() {
  ::pthread_kill(thread_.native_handle(), end_of_watch);
  thread_.join();
  ::pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

void InterruptGuard::wait_for_signals(OutputFiles& files) const {
  int signal = 0;
  if (::sigwait(&watched_, &signal) != 0 || signal == end_of_watch) return;
  files.discard();
  std::fputs("\nwavebalance: interrupted, no results written\n", stderr);
  ::_exit(128 + signal);
}

}  // namespace wavebalance::app
