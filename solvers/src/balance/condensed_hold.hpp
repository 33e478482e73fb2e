#pragma once
#include <cmath>

#include "structure/held_structure.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// The springs that hold a structure that is free to move, and what a problem keeps of them.
struct CondensedProblem::Hold {
  explicit Hold(const LinearStructure& structure, const TimePair& pair) : held(solvers::hold(structure)) {
    // A constant force of 1 at the points, and the coefficient k = 0 of a constant displacement of 1.
    Eigen::VectorXcd constant = Eigen::VectorXcd::Zero(pair.points() / 2 + 1), projection;
    constant[0] = pair.points();
    pair.project(constant, projection);
    match = std::real(pair.symbol(0)[0] * constant[0] / (pair.trial_spectrum()[0] * projection[0]));
  }
  void set_frequency(double frequency) {
    const double at = held.spring_stiffness(frequency);
    if (at != stiffness) response.resize(0, 0);
    stiffness = at;
  }
  HeldStructure held;
  double stiffness = 0.0;  // kappa at the frequency, N/m
  double match;            // a spring's force on the functions over that at the points, 1 to rounding
  Eigen::MatrixXd response;
};

}  // namespace wavebalance::solvers
