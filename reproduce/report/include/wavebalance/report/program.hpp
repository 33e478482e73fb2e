#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wavebalance/report/record.hpp"

namespace wavebalance::report {

class Artefact;

/// One figure, table or reference solution of a paper, and the function that makes it.
struct Step {
  std::string name;  ///< as the command line gives it, "fig06"
  Identity identity;
  std::function<void(Artefact&)> make;
};

/// The main function of a paper's program, `program NAME [--output DIR] [--scenes DIR]`: makes and writes the
/// step of that name. Returns the exit code: 0; 2 for bad input and for files that cannot be written, nothing
/// being written; 3 for NotConverged. Messages go to stderr. `steps` must not be empty and belong to one
/// paper.
int run_program(int argc, const char* const* argv, const std::vector<Step>& steps);

}  // namespace wavebalance::report
