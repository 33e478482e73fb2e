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
  /// Makes it large enough for a vibration of one mode: half sides of its displacement and velocity.
  void include_mode(Eigen::Index mode, double displacement, double velocity);
  /// A state uniform in the box.
  StructureState random(std::mt19937& generator) const;

  /// Keeps a motion of the contacts over a period of the load, as one that may be near a resonance.
  void add_resonance(Motion contacts) { resonances_.push_back(std::move(contacts)); }
  const std::vector<Motion>& resonances() const { return resonances_; }

  const Eigen::MatrixXd& shapes() const { return shapes_; }          ///< n x m, mass-normalised
  const Eigen::MatrixXd& projection() const { return projection_; }  ///< m x n
  /// The half sides as they are told.
  std::vector<BoxSide> sides() const;

 private:
  Eigen::MatrixXd shapes_, projection_;      // n x m, m x n
  Eigen::VectorXd middle_;                   // of the displacements, m
  Eigen::VectorXd displacement_, velocity_;  // half sides, m
  std::vector<Motion> resonances_;
};

/// A box around what the static loads deflect, with the contacts that they close. It holds twice the
/// vibration without contact at a frequency of the load (Hz), which is enlarged until it reaches a gap, and
/// twice the resonant vibrations that the laws move there. Such is one of a single mode, or of the shape that
/// the structure has with one contact as the spring that tunes it, whose frequency, with the stiffness that
/// the contacts have in the first harmonic, is that of a harmonic of the load, and of which the damping takes
/// no more than the work of the load: resonances() are these, with the two phases in which the damping takes
/// what the load gives. Nothing where the structure has no modes to compute. O((modes + contacts) contacts)
/// evaluations of the laws.
std::optional<StateBox> box_of_motions(ContactProblem& problem, double frequency);

}  // namespace wavebalance::solvers::detail
