#pragma once
#include <Eigen/Core>
#include <optional>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// The exact motion of a structure over a step of time, for contact forces that are linear within the step:
///
///   y(t + h) = E y(t) + B0 f(t) + B1 f(t + h),
///
/// y = (sigma q, dq/dt) the state of its modes q, in which the norm of y is the energy norm: sigma is the
/// natural angular frequency or, if that is larger, the load's. Modes belong to M and the symmetric part of
/// K, and the skew parts of C and K couple them. Structural damping is replaced by the viscous one with the
/// same damping of each mode at its natural frequency. E, B0 and B1 are integrals of the matrix exponential
/// [C. F. Van Loan, IEEE Trans. Autom. Control 23, 1978]. Immutable; O(m^2) per step with m modes.
class ModalFlow {
 public:
  /// step in s, frequency in Hz (> 0). The lowest `max_modes` modes are used; the others follow their
  /// static deflection. So do modes of massless degrees of freedom, which are found with 1e-9 of the mean
  /// mass. Nothing when the modes are not found: mass neither positive definite nor zero on its diagonal.
  /// O(n^3).
  static std::optional<ModalFlow> make(const LinearStructure& structure, double frequency, double step,
                                       int max_modes);
  /// The same structure over another step, in s. O(m^3).
  ModalFlow over(double step) const;
  /// Lets a constant load (n, N) act besides the contact forces. O(m^3).
  void set_constant_load(const Eigen::VectorXd& load);

  Eigen::Index modes() const { return shapes_.cols(); }  ///< m
  Eigen::Index states() const { return 2 * modes(); }
  const Eigen::MatrixXd& shapes() const { return shapes_; }          ///< n x m, mass-normalised
  const Eigen::MatrixXd& projection() const { return projection_; }  ///< m x n, shapes^T mass: to modes

  /// Takes a state over a step in which the contact forces (C, N) vanish at the end; to be followed by
  /// add_force().
  Eigen::VectorXd advance(const Eigen::VectorXd& state, const Eigen::VectorXd& force) const;
  /// Adds what forces at the end of the step have caused.
  void add_force(Eigen::VectorXd& state, const Eigen::VectorXd& force) const;

  /// Displacements of the contacts (C, m) in a state, without the static deflection under present forces.
  Eigen::VectorXd contact_displacement(const Eigen::VectorXd& state) const;
  void add_contact_displacement(const Eigen::VectorXd& state, Eigen::VectorXd& to) const;
  /// The same at the end of a step without contact forces. O(C m).
  void add_contact_displacement_after(const Eigen::VectorXd& state, Eigen::VectorXd& to) const;
  /// C x C, m/N: reduction of the displacements at the end of a step by forces there, static deflection of
  /// the omitted modes included. Symmetric, not negative.
  const Eigen::MatrixXd& step_compliance() const { return step_compliance_; }
  /// The part of the omitted modes.
  const Eigen::MatrixXd& static_compliance() const { return static_compliance_; }
  /// Velocities of the contacts (C, m/s) in a state.
  void add_contact_velocity(const Eigen::VectorXd& state, Eigen::VectorXd& to) const;
  /// C x C, m/s/N: reduction of the velocities at the end of a step by forces there.
  const Eigen::MatrixXd& step_mobility() const { return step_mobility_; }
  /// State of a displacement (n, m) and a velocity (n, m/s). O(n m).
  Eigen::VectorXd state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const;

 private:
  ModalFlow() = default;
  void set_step(double step);

  Eigen::MatrixXd shapes_, projection_;
  Eigen::VectorXd sigma_;                 // m, rad/s
  Eigen::MatrixXd contact_, to_contact_;  // C x m, of displacements and velocities q and of sigma q
  Eigen::MatrixXd rates_;                 // 2m x 2m, of the first-order form, 1/s
  Eigen::MatrixXd static_compliance_;     // C x C, m/N, of the omitted modes
  double step_ = 0.0;                     // s
  Eigen::VectorXd constant_, drift_, contact_drift_;  // m, of the load; what it adds to a state in a step
  Eigen::MatrixXd exponential_, contact_exponential_, begin_, end_, step_compliance_, step_mobility_;
};

}  // namespace wavebalance::solvers
