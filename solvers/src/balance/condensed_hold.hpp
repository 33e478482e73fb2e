#pragma once
#include <cmath>

#include "structure/held_structure.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// What a problem has of a structure that is free to move.
struct CondensedProblem::Hold {
  explicit Hold(const LinearStructure& structure, const TimePair& pair) : held(solvers::hold(structure)) {
    // A force of 1 that is constant in time, and the coefficient of a displacement of 1, at k = 0.
    Eigen::VectorXcd constant = Eigen::VectorXcd::Zero(pair.points() / 2 + 1), projection;
    constant[0] = pair.points();
    pair.project(constant, projection);
    match = std::real(pair.symbol(0)[0] * constant[0] / (pair.trial_spectrum()[0] * projection[0]));
  }
  HeldStructure held;
  double match;  // of a spring on the functions to a force at the points, 1 to rounding
  Eigen::MatrixXd response;
};

}  // namespace wavebalance::solvers
