#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

namespace wavebalance::solvers::testing {

/// The clamped rod of [LL10, section 5.1] in units length = E = rho = area = gap = 1, as its own linear
/// modes.
struct UnitRod {
  Eigen::MatrixXd stiffness, mass;
  Eigen::MatrixXd shapes;  // mass-normalised, columns
  ModalModel model;

  explicit UnitRod(int elements, double lumped_fraction = 0.0);
};

}  // namespace wavebalance::solvers::testing
