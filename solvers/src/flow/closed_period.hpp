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
  double period = missing;    ///< s, of the flow, or that found where it is an unknown
  double distance = missing;  ///< of the state one period later, in displacements relative to the motion
  Eigen::MatrixXd map;        ///< what becomes of perturbations of the state in a period, there or near
};

/// Newton's method on the map of the period, from where the flow is; the flow is then at the end of the
/// period found. A step that leads farther away is halved; where the contacts end in other states than they
/// began in, and where no part of a step helps, the motion goes on by a period. `map`: one that is known from
/// near, which serves as long as a step leaves a tenth at most; else each step carries all perturbations over
/// a period.
///
/// With `free_period`, of a flow without periodic load, the period is an unknown, too, and each step is
/// perpendicular to the motion, so that the phase of the start is kept.
ClosedPeriod close_period(ContactFlow& flow, int most_iterations, const Observer& observer = {},
                          Eigen::MatrixXd map = {}, bool free_period = false);

/// Estimated floating-point operations of a panel with so many states, rows and perturbations; and of the
/// last period of a flow with its perturbations, in operations of small matrices.
double panel_operations(Eigen::Index states, int rows, Eigen::Index perturbations);
double period_operations(const ContactFlow& flow, int rows);

/// The states that a map of a period changes: a memory that it leaves as it is has a row of the unit matrix,
/// and one without a meaning none.
std::vector<Eigen::Index> free_states(const Eigen::MatrixXd& map);

/// The multipliers of a map by falling modulus, without the multiplier 1 of a slider that does not move.
Eigen::VectorXcd multipliers_of(const Eigen::MatrixXd& map);

/// The multipliers of a state that comes back by falling modulus. The multiplier 1 of a slider that does
/// not move is excluded, and with `free_period` the one of a perturbation along the motion. Empty where
/// perturbations are not resolved.
Eigen::VectorXcd multipliers_of(ContactFlow& flow, const ClosedPeriod& closed, bool free_period = false);

}  // namespace wavebalance::solvers::detail
