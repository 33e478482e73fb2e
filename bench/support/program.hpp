#pragma once
#include <filesystem>
#include <functional>

namespace wavebalance::bench {

/// What the benchmark programs are called with: `--output DIR [--quick]`.
struct Program {
  std::filesystem::path output;  ///< folder of the csv files and pictures
  bool quick = false;            ///< the smallest sizes only, to see that the program works
};

/// Reads the arguments and runs `body`; what it throws goes to stderr. Returns the exit code: 0, or 2 for bad
/// arguments and for anything thrown.
int run_program(int argc, char** argv, const std::function<void(const Program&)>& body);

}  // namespace wavebalance::bench
