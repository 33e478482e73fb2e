#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers::detail {

/// The loads of a problem's structure by harmonics of their own period, of which the problem's period has
/// `repeats`, N: a row for each column of LinearStructure::load_shapes(), a column for each harmonic.
Eigen::MatrixXcd loads_of(const CondensedProblem& problem, int repeats);

/// The structure, and where it is free to move with the springs ContactDynamics::holding() along all
/// contacts.
LinearStructure held_by_springs(const LinearStructure& structure, double holding);

}  // namespace wavebalance::solvers::detail
