#pragma once
#include <optional>
#include <string>
#include <vector>

namespace wavebalance::report {

/// One argument of a program: "--output" is an option with the value as its default; "name" a required
/// position.
struct Argument {
  std::string name;
  std::string* value;
  std::string help;
  std::vector<std::string> allowed = {};  ///< any text if empty
};

/// Reads the arguments into their values. Returns an exit code where nothing is left to do: 0 after help, 2
/// after bad input, which has been reported on stderr.
std::optional<int> read_arguments(int argc, const char* const* argv, const std::string& description,
                                  const std::string& footer, const std::vector<Argument>& arguments);

}  // namespace wavebalance::report
