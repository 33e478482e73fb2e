#pragma once
#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

#include "wavebalance/solvers/problem/coexisting_motions.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers::detail {

/// The state of all degrees of freedom at one instant, n values each.
struct StructureState {
  Eigen::VectorXd displacement, velocity;  ///< m, m/s
};

/// A box of the modes' displacements and velocities that holds motions.
struct StateBox {
  Eigen::MatrixXd shapes, projection;      // n x m, mass-normalised, and m x n
  Eigen::VectorXd middle;                  // of the displacements, m
  Eigen::VectorXd displacement, velocity;  // half sides, m
  std::vector<Motion> resonances;          // of the contacts over a period of the load, which may be near one

  /// Makes it large enough for a motion of all degrees of freedom whose distance from the middle is
  /// multiplied by `factor`.
  void include(const Motion& motion, double factor);
  /// A state uniform in the box.
  StructureState random(std::mt19937& generator) const;
  /// The half sides as they are told.
  std::vector<BoxSide> sides() const;
};

/// A box around what the static loads deflect, with the contacts that they close. It holds twice the
/// vibration without contact at a frequency of the load (Hz), which is enlarged until it reaches a gap, and
/// twice the resonant vibrations that the laws move there. Such is one of a single mode, or of the shape that
/// the structure has with one contact as the spring that tunes it, whose frequency, with the stiffness that
/// the contacts have in the first harmonic, is that of a harmonic of the load, and of which the damping takes
/// no more than the work of the load: `resonances` are these, with the two phases in which the damping takes
/// what the load gives. Nothing where the structure has no modes to compute. O((modes + contacts) contacts)
/// evaluations of the laws.
std::optional<StateBox> box_of_motions(ContactProblem& problem, double frequency);

}  // namespace wavebalance::solvers::detail
