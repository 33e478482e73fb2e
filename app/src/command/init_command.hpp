#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/run_report.hpp"

namespace wavebalance::app {

struct InitArguments {
  std::string kind = "bar";      ///< one of starter_kinds()
  std::filesystem::path output;  ///< the scene; empty: <kind>.toml in the current folder
};

/// "bar", "matrices", "blade", "study".
std::vector<std::string> starter_kinds();

/// A commented scene of this kind, or a study, to start from, first, and the files that it reads, whose names
/// begin with `stem`. Throws std::invalid_argument for another kind.
std::vector<ResultFile> starter_scene(const std::string& kind, const std::string& stem);

/// Writes starter_scene() and says what to do next; stem is that of the output. Returns solved. Throws
/// std::invalid_argument, also if one of the files exists, and IoError.
int init_scene(const InitArguments& arguments);

}  // namespace wavebalance::app
