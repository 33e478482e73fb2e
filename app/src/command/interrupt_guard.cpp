#include "command/commands.hpp"

#include <pthread.h>
#include <unistd.h>

#include <atomic>

namespace wavebalance::app {
namespace {

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};

// Read by threads, too.
std::atomic<int> note_first_signal = 0;
std::atomic<int> noted_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // as a signal handler needs it

/// Writes in the one way that a signal handler may.
void say(std::string_view message) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
}

[[noreturn]] void end_now(int signal) {
  say("\nwavebalance: interrupted, no results written\n");
  ::_exit(128 + signal);
}

void handle(int signal) {
  if (note_first_signal == 0 || noted_signal != 0) end_now(signal);
  noted_signal = signal;
  say("\nwavebalance: interrupted; ends after this point, or at once with a second signal\n");
}

bool is_ignored(int signal) {
  struct sigaction current {};
  ::sigaction(signal, nullptr, &current);
  return current.sa_handler == SIG_IGN;
}

}  // namespace

InterruptGuard::InterruptGuard(bool note_first) {
  note_first_signal = note_first ? 1 : 0;
  noted_signal = 0;
  ::sigemptyset(&watched_);
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  for (const int signal : signals) {
    if (is_ignored(signal)) continue;
    ::sigaddset(&watched_, signal);
    ::sigaction(signal, &action, nullptr);
  }
  ::pthread_sigmask(SIG_BLOCK, nullptr, &previous_);
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : signals)
    if (::sigismember(&watched_, signal) == 1) std::signal(signal, SIG_DFL);
  ::pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

int InterruptGuard::signal() const { return noted_signal; }

void InterruptGuard::defer() { ::pthread_sigmask(SIG_BLOCK, &watched_, nullptr); }

void InterruptGuard::end_program() const { end_now(noted_signal); }

}  // namespace wavebalance::app
