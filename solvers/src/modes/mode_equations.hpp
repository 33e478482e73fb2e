#pragma once
#include <Eigen/Core>

#include "modes/pair_transform.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"

namespace wavebalance::solvers {

/// Data of the equations of an elastic mode. Immutable.
struct ModeProblem {
  ModalModel model;
  int mode = 0;  ///< of the model's columns, from 0
  PairTransform transform;
  ContactLaws laws;             ///< as given
  Eigen::VectorXd flexibility;  ///< 1 / epsilon of each contact, m/N; empty in the displacement form
  double amplitude = 0.0;       ///< of the mode's coefficient at linear grazing, m sqrt(kg), with its sign
  double unit = 0.0;            ///< m, unit of coefficients: the largest of the contacts' at grazing

  int contacts() const { return model.contacts(); }
  int rows() const { return transform.rows(); }
  int size() const { return contacts() * rows() + 2; }
  double omega() const;         ///< rad/s, of the linear mode
  double linear_omega() const;  ///< rad/s, the same as the pair of bases has it
  double first_inertia() const { return transform.inertia[1]; }
};

/// The balance of a free motion, condensed on the contacts, with the first harmonic of the continued mode m
/// kept as an unknown. In spectra over translates
///
///   u(k) = [k = 1] s_m q - sum_j s_j s_j^T psi(k) / (omega_j^2 - inertia(k) omega^2),   without (1, m),
///   (omega_m^2 - inertia(1) omega^2) q + Re s_m^T psi(1) = 0,
///
/// psi the coefficients of the contact force and s_j the mode shapes at the contacts. Unlike the compliance
/// of all modes these are regular at omega_m. A real q fixes the phase. The imaginary part of the last
/// equation is left out for it: it is the work of the sampled force over the period, which is zero for
/// exact integrals and for motions even in time. The force form has v = u + psi / epsilon instead of u.
///
/// Unknowns y, C R + 2: coefficients of each contact over `unit`, q over `amplitude`, omega over omega_m.
class ModeEquations {
 public:
  explicit ModeEquations(const ModeProblem& problem);

  /// Leaves out all coefficients above harmonic `highest`, at least 1; K keeps all.
  void set_highest(int highest) { highest_ = highest; }
  int highest() const { return highest_; }

  /// Residual (C R + 1) and forces at y. O(K r C^2 + C N R).
  void evaluate(const Eigen::VectorXd& y);
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::VectorXd& unknowns() const { return y_; }  ///< of that state
  double omega() const { return omega_; }                 ///< rad/s, of that state
  double relative_residual() const;
  /// The equation left out, over the amplitude of the linear mode's elastic force at grazing.
  double imbalance() const;
  /// (C R + 1) x (C R + 2), derivatives of the residual at the state last evaluated. O(C R^2 active + (C
  /// R)^2).
  Eigen::MatrixXd jacobian() const;

  const ModeProblem& problem() const { return problem_; }
  const Eigen::MatrixXd& force() const { return force_; }  ///< N x C
  /// Displacements of the contacts, N x C, m.
  Eigen::MatrixXd displacement() const;
  /// Those at which the laws have their forces: in the force form these agree with displacement() within the
  /// error of the trial functions.
  Eigen::MatrixXd displacement_of_laws() const;
  /// Coefficients of all modes, R x r, m sqrt(kg).
  Eigen::MatrixXd modal_coefficients() const;

 private:
  void set_compliance(double omega);
  void set_forces();
  double last_scale() const;
  Eigen::MatrixXd force_slope(int contact) const;
  double gain(int k, int mode) const;  // 1 / (omega_j^2 - inertia(k) omega^2), 0 where it is left out

  const ModeProblem& problem_;
  ContactLaws laws_;  // of the form
  Eigen::VectorXd y_, residual_;
  double omega_ = 0.0;
  int highest_;
  Eigen::MatrixXd compliance_, slope_;  // K + 1 x C^2, (c, d) in column c + C d; slope by omega / omega_m
  Eigen::MatrixXd samples_, force_, tangent_, psi_;
};

}  // namespace wavebalance::solvers
