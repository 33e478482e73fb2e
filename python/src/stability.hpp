#pragma once
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::python {

/// The options that the command takes: harmonics of the trial functions, at most 255.
solvers::StabilityOptions stability_options(const solvers::CondensedProblem& problem);

}  // namespace wavebalance::python
