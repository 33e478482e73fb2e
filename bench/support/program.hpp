#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

namespace wavebalance::bench {

/// Arguments of the benchmark programs: `--output DIR [--quick]`.
struct Program {
  std::filesystem::path output;  ///< folder of the csv files and pictures
  bool quick = false;            ///< the smallest sizes only, to see that the program works
};

/// Reads the arguments and runs `body`; what it throws goes to stderr. With `--help` it prints how the
/// program is called and `about`, sentences on what it measures and writes, and runs nothing. Returns the
/// exit code: 0, or 2 for bad arguments and for anything thrown.
int run_program(int argc, char** argv, std::string_view about,
                const std::function<void(const Program&)>& body);

}  // namespace wavebalance::bench
