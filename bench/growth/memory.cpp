#include "memory.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>

namespace wavebalance::bench {
namespace {

double largest_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

[[noreturn]] void report(const std::function<void()>& warm_up, const std::function<void()>& work,
                         int pipe_end) {
  double bytes = std::numeric_limits<double>::quiet_NaN();
  try {
    warm_up();
    const double before = largest_resident_bytes();
    work();
    bytes = largest_resident_bytes() - before;
  } catch (...) {
  }
  const bool written = write(pipe_end, &bytes, sizeof bytes) == sizeof bytes;
  _exit(written ? 0 : 1);
}

}  // namespace

double peak_bytes(const std::function<void()>& warm_up, const std::function<void()>& work) {
  double bytes = std::numeric_limits<double>::quiet_NaN();
  int ends[2];
  if (pipe(ends) != 0) return bytes;
  malloc_trim(0);  // free memory in the heap would hide the child's use
  const pid_t child = fork();
  if (child == 0) report(warm_up, work, ends[1]);
  close(ends[1]);
  if (child > 0) {
    if (read(ends[0], &bytes, sizeof bytes) != sizeof bytes) bytes = std::numeric_limits<double>::quiet_NaN();
    waitpid(child, nullptr, 0);
  }
  close(ends[0]);
  return bytes;
}

}  // namespace wavebalance::bench
