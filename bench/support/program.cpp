#include "program.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/linalg/blas_threads.hpp"

namespace wavebalance::bench {
namespace {

constexpr std::string_view options =
    "  --output DIR   folder of the files\n"
    "  --quick        the smallest sizes only, to see that the program works\n"
    "  --help         this text\n";

bool asks_for_help(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](std::string_view one) { return one == "--help"; });
}

Program read_arguments(int argc, char** argv) {
  Program program;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick")
      program.quick = true;
    else if (argument == "--output" && i + 1 < argc)
      program.output = argv[++i];
    else
      throw std::invalid_argument("argument \"" + argument +
                                  (argument == "--output" ? "\": the folder after it is missing" : "\"") +
                                  "; allowed: --output DIR [--quick], or --help");
  }
  if (program.output.empty()) throw std::invalid_argument("--output DIR is missing");
  return program;
}

}  // namespace

int run_program(int argc, char** argv, std::string_view about,
                const std::function<void(const Program&)>& body) {
  if (asks_for_help(argc, argv)) {
    std::cout << "usage: " << std::filesystem::path(argv[0]).filename().string()
              << " --output DIR [--quick]\n\n"
              << about << "\n\n"
              << options;
    return 0;
  }
  solvers::use_one_blas_thread();
  try {
    body(read_arguments(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 2;
  }
}

}  // namespace wavebalance::bench
