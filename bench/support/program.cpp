#include "program.hpp"

#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/linalg/blas_threads.hpp"

namespace wavebalance::bench {
namespace {

Program read_arguments(int argc, char** argv) {
  Program program;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick")
      program.quick = true;
    else if (argument == "--output" && i + 1 < argc)
      program.output = argv[++i];
    else
      throw std::invalid_argument("argument \"" + argument + "\"; allowed: --output DIR [--quick]");
  }
  if (program.output.empty()) throw std::invalid_argument("--output DIR is missing");
  return program;
}

}  // namespace

int run_program(int argc, char** argv, const std::function<void(const Program&)>& body) {
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
