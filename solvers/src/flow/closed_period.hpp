#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/flow/contact_flow.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::solvers::detail {

/// A state of a flow that comes back after a period.
struct ClosedPeriod {
  bool found = false;
  int iterations = 0;
  Eigen::VectorXd state;      ///< ContactFlow::state() at the beginning
  std::vector<int> contacts;  ///< and the states of the machines
  double distance = missing;  ///< of the state one period later, relative, in displacements
  Eigen::MatrixXd map;        ///< what becomes of perturbations of the state in a period, there or near
};

/// Newton's method on the map of the period, from where the flow is; the flow is then at the end of the
/// period found. A step that leads farther away is halved; where the contacts end in other states than they
/// began in, and where no part of a step helps, the motion goes on by a period. `map`: one that is known from
/// near, which serves as long as a step leaves a tenth at most; else each step carries all perturbations over
/// a period.
ClosedPeriod close_period(ContactFlow& flow, int most_iterations, const Observer& observer = {},
                          Eigen::MatrixXd map = {});

/// The multipliers of a state that comes back by falling modulus. That of 1 of a slider which does not move
/// is left out. Empty where perturbations are not resolved.
Eigen::VectorXcd multipliers_of(ContactFlow& flow, const ClosedPeriod& closed);

}  // namespace wavebalance::solvers::detail
