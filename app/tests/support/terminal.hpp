#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <string>

namespace wavebalance::app {

/// A pseudo-terminal: a program writes to the terminal at path(), and what it has written is read here.
class Terminal {
 public:
  Terminal() : reader_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    EXPECT_EQ(::grantpt(reader_), 0);
    EXPECT_EQ(::unlockpt(reader_), 0);
  }
  ~Terminal() { ::close(reader_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  std::string path() const { return ::ptsname(reader_); }

  /// All that was written so far.
  const std::string& text() { return read(0); }
  /// All that is written until the last program with this terminal ends.
  const std::string& whole_text() { return read(-1); }

 private:
  /// Reads until nothing comes for `milliseconds`; for ever if they are negative.
  const std::string& read(int milliseconds) {
    pollfd waiting{reader_, POLLIN, 0};
    char part[4096];
    while (::poll(&waiting, 1, milliseconds) > 0) {
      const ssize_t size = ::read(reader_, part, sizeof part);
      if (size <= 0) break;
      text_.append(part, static_cast<std::size_t>(size));
    }
    return text_;
  }

  int reader_;
  std::string text_;
};

}  // namespace wavebalance::app
