#pragma once
#include <Eigen/Core>
#include <stdexcept>
#include <vector>

#include "wavebalance/solvers/balance/contact_law.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::oracle {

/// How shooting ended.
enum class ShootingStatus {
  converged,        ///< the state returns to itself after one period
  stalled,          ///< no step along Newton's direction reduces the residual
  iteration_limit,  ///< max_iterations was reached
  step_failure      ///< the contact force could not be resolved in time, e.g. a law that jumps
};

/// How a periodic motion is sought in the state space.
struct ShootingOptions {
  int output_points = 1024;   ///< uniform samples of the period
  int settling_periods = 10;  ///< periods integrated from the initial state before Newton starts
  int max_iterations = 30;    ///< Newton steps on the period map
  double tolerance = 1e-11;   ///< on the relative change of the state over one period, in the energy norm
  /// Bound on a step's error in the contact impulse, relative to the period times the largest force.
  double step_tolerance = 1e-12;
  bool full_history = false;               ///< also keep every degree of freedom
  Eigen::VectorXd initial_displacement{};  ///< n, m, at t = 0; empty: that of the response without contact
  Eigen::VectorXd initial_velocity{};      ///< n, m/s, at t = 0; empty: that of the response without contact
};

/// The periodic motion and its stability.
struct ShootingResult {
  ShootingStatus status = ShootingStatus::iteration_limit;
  int iterations = 0;                    ///< Newton steps taken
  double residual = 0.0;                 ///< relative change of the state over one period, energy norm
  std::vector<double> residual_history;  ///< before each Newton step and at the end
  long steps = 0;                        ///< time steps in all
  Eigen::VectorXd displacement;          ///< n, m, at t = 0, the maximum of `load`
  Eigen::VectorXd velocity;              ///< n, m/s, at t = 0
  Eigen::VectorXcd floquet_multipliers;  ///< 2n, of the last iterate, by falling modulus
  solvers::Motion contacts;  ///< of the one contact, from the last iterate on; empty on step_failure
  solvers::Motion
      structure;  ///< the same of all n degrees of freedom, without forces; with full_history only
};

/// The periodic response of M u'' + C u' + K u = load cos(2 pi f t) + forces - e f_c(u_c) by Newton on the
/// period map (u, u')(0) -> (u, u')(T), with its derivative by the variational equations. It shares no time
/// basis, integrator, equations or dense matrices with the library, which it checks.
///
/// The deviation from the response without contact is propagated in the modes, exactly for a contact force
/// that is a polynomial of degree 5 through the Gauss points of a step (exponential collocation), whatever
/// the damping of the mode. Steps are halved about the instants where the law has its kink. Contacts shorter
/// than about a thousandth of the period that start and end between two points can be missed.
///
/// Cost: O(n^2) per step, O(n^3) per iteration, O(n^2) memory, at least 512 steps per period.
///
/// Throws std::invalid_argument when the structure does not fit together, its mass is not positive definite,
/// its modes do not decouple the damping, an undamped mode is loaded at its own frequency, frequency_hz (Hz)
/// is not positive and finite, or the force depends on the velocity. Options are not checked.
ShootingResult shoot(const solvers::LinearStructure& structure, const solvers::AnyContactLaw& law,
                     double frequency_hz, const ShootingOptions& options = {});

/// The motion at so many points that a test needs: without one, std::runtime_error.
inline ShootingResult shot_motion(const solvers::LinearStructure& structure,
                                  const solvers::AnyContactLaw& law, double frequency_hz, int points) {
  ShootingResult result = shoot(structure, law, frequency_hz, {.output_points = points});
  if (result.status != ShootingStatus::converged) throw std::runtime_error("shooting found no motion");
  return result;
}

}  // namespace wavebalance::oracle
