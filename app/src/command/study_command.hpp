#pragma once
#include <filesystem>

namespace wavebalance::app {

struct StudyArguments {
  std::filesystem::path study;
  std::filesystem::path output;
  int threads = 0;  ///< that solve runs; 0: one per core, or with mpirun one per process
  bool quiet = false;
  bool report = true;  ///< whether report.html is written
};

/// Solves a scene over values of its keys, from where an earlier start stopped, and writes the results. Below
/// mpirun this is the part of one process. Returns solved, not_converged if a run did not, or interrupted +
/// signal with the runs so far. Throws SceneError, IoError, std::invalid_argument and std::runtime_error.
int solve_study(const StudyArguments& arguments);

}  // namespace wavebalance::app
