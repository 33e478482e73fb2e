#pragma once
#include "report/arguments.hpp"

namespace wavebalance::app {

/// Solves a scene over values of its keys, from where an earlier start stopped, and writes the results. Below
/// mpirun this is the part of one process. Returns solved, not_converged if a run did not, or interrupted +
/// signal with the runs so far. Throws SceneError, IoError, std::invalid_argument and std::runtime_error.
int solve_study(const StudyArguments& arguments);

}  // namespace wavebalance::app
