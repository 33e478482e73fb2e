#pragma once
#include <Eigen/Core>
#include <optional>
#include <random>

#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers::detail {

/// The state of all degrees of freedom at one instant, n values each.
struct StructureState {
  Eigen::VectorXd displacement, velocity;  ///< m, m/s
};

/// A box of the modes' displacements and velocities that holds motions: around rest, or another displacement.
class StateBox {
 public:
  /// Nothing where the structure has no modes to compute. `frequency` is that of the load, Hz. O(n^3).
  static std::optional<StateBox> make(const LinearStructure& structure, double frequency, int max_modes);

  /// Puts the displacement of all degrees of freedom in the middle; before include().
  void set_middle(const Eigen::VectorXd& displacement);
  /// Makes it large enough for a motion of all degrees of freedom whose distance from the middle is
  /// multiplied by `factor`.
  void include(const Motion& motion, double factor);
  /// A state uniform in the box.
  StructureState random(std::mt19937& generator) const;

 private:
  Eigen::MatrixXd shapes_, projection_;      // n x m, m x n
  Eigen::VectorXd middle_;                   // of the displacements, m
  Eigen::VectorXd displacement_, velocity_;  // half sides, m
};

/// A box around what the static loads deflect, with the contacts that they close. It holds twice the
/// vibration without contact at a frequency of the load (Hz), which is enlarged until it reaches a gap.
/// Nothing where the structure has no modes to compute.
std::optional<StateBox> box_of_free_motion(ContactProblem& problem, double frequency);

}  // namespace wavebalance::solvers::detail
