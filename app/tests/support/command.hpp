#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "temporary_folder.hpp"
#include "terminal.hpp"
#include "wavebalance/app/files/output.hpp"

namespace wavebalance::app {

/// How the command ended, and what it wrote.
struct Outcome {
  int exit_code = -1;
  std::string output;
  std::string errors;
};

/// The command with its streams in files of `folder`, or with its errors on a terminal, where progress shows
/// after half a second rather than five.
class Command {
 public:
  Command(const TemporaryFolder& folder, std::vector<std::string> arguments, const std::string& program,
          Terminal* terminal = nullptr)
      : output_(folder / "stdout"),
        errors_(terminal ? std::filesystem::path(terminal->path()) : folder / "stderr"),
        terminal_(terminal) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> pointers;
    for (auto& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 1, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::posix_spawn_file_actions_addopen(&actions, 2, errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY,
                                       0644);
    EXPECT_EQ(::posix_spawnp(&child_, pointers[0], &actions, nullptr, pointers.data(), environ), 0);
    ::posix_spawn_file_actions_destroy(&actions);
  }

  void send(int signal) const { ::kill(child_, signal); }

  /// Whether the program has a handler for the signal, as /proc says.
  bool catches(int signal) const {
    const std::string status = read_file("/proc/" + std::to_string(child_) + "/status");
    const auto place = status.find("SigCgt:");
    return place != std::string::npos &&
           (std::stoull(status.substr(place + 7), nullptr, 16) >> (signal - 1) & 1) == 1;
  }

  Outcome wait() {
    const std::string shown = terminal_ ? terminal_->whole_text() : "";  // a full terminal stops the command
    int status = 0;
    ::waitpid(child_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_file(output_),
            terminal_ ? shown : read_file(errors_)};
  }

 private:
  std::filesystem::path output_, errors_;
  Terminal* terminal_;
  pid_t child_ = 0;
};

inline Outcome run(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  return Command(folder, std::move(arguments), WAVEBALANCE_COMMAND).wait();
}

}  // namespace wavebalance::app
