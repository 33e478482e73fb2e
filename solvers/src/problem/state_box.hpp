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
  /// The half sides as reported.
  std::vector<BoxSide> sides() const;
};

/// A box around the static deflection with its closed contacts. It covers twice the linear response at a
/// forcing frequency (Hz), enlarged until it reaches a gap, and twice the resonant vibrations that the laws
/// move there. A resonant vibration has the shape of a single mode, or of the structure with one contact as
/// a tuned spring. Its frequency, with the stiffness of the contacts in the first harmonic, is a harmonic
/// of the load, and the damping dissipates at most the work of the load. `resonances` are these, with the
/// two phases in which damping and load are balanced. Nothing if the structure has no modes. O((modes +
/// contacts) contacts) evaluations of the laws.
std::optional<StateBox> box_of_motions(ContactProblem& problem, double frequency);

}  // namespace wavebalance::solvers::detail
