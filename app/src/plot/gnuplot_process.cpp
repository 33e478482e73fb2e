#include "plot/plot_parts.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw PlotError("gnuplot: " + what + ": " + std::strerror(error));
}

/// A file without a name: gone with its descriptor, whatever happens. Files cannot block as pipes can when
/// one side waits for the other.
class Scratch {
 public:
  Scratch() : file_(std::tmpfile()) {
    if (!file_) fail("no temporary file", errno);
    ::fcntl(descriptor(), F_SETFD, FD_CLOEXEC);
  }

  int descriptor() const { return ::fileno(file_.get()); }

  void write(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
    if (!written || std::fflush(file_.get()) != 0)
      fail("its commands cannot be written to a temporary file", errno);
    ::lseek(descriptor(), 0, SEEK_SET);
  }

  /// Output of the child through its copy of the descriptor, which shares the position.
  std::string read() {
    std::string text;
    std::array<char, 65536> buffer;
    ::lseek(descriptor(), 0, SEEK_SET);
    for (ssize_t n = 0; (n = ::read(descriptor(), buffer.data(), buffer.size())) != 0;) {
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("its output cannot be read", errno);
      text.append(buffer.data(), static_cast<std::size_t>(n));
    }
    return text;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

/// The child's three streams, and signals as a program expects them, whatever this one blocks.
class SpawnSetup {
 public:
  SpawnSetup(int input, int output, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    sigset_t none;
    ::sigemptyset(&none);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnSetup() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;

  pid_t spawn() {
    std::array<char*, 3> arguments{const_cast<char*>("gnuplot"), const_cast<char*>("-d"), nullptr};
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, "gnuplot", &actions_, &attributes_, arguments.data(), environ);
    if (error != 0) fail("cannot be started (it draws the pictures; is gnuplot installed?)", error);
    return child;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail("cannot be waited for", errno);
  return status;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  Scratch input, output, errors;
  input.write(script);
  const pid_t child = SpawnSetup(input.descriptor(), output.descriptor(), errors.descriptor()).spawn();
  const int status = wait_for(child);
  const std::string words = errors.read();
  if (WIFSIGNALED(status)) throw PlotError("gnuplot was ended by signal " + std::to_string(WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0)
    throw PlotError("gnuplot failed (status " + std::to_string(WEXITSTATUS(status)) + "): " + words);
  std::string picture = output.read();
  if (picture.empty()) throw PlotError("gnuplot drew nothing: " + words);
  return picture;
}

}  // namespace wavebalance::app
