#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers {

/// A structure of modes whose contacts meet rigid obstacles with Newton's law of restitution: contact c stays
/// at or below its gap, and where it reaches it with the velocity v > 0, an impulse p along its direction
/// leaves it with the velocity -e_c v. With J = S M^-1 S^T, p J_cc = (1 + e_c) v.
struct ImpactsProblem {
  const ContactDynamics& dynamics;  ///< must outlive what refers to it
  /// C x (H + 1), m: the motion without contact, column n belongs to Re(a exp(2 pi i n t)), t in periods.
  Eigen::MatrixXcd contact_free;
  double frequency = 0.0;            ///< 1 / period of the motion, Hz
  Eigen::VectorXd gaps = {};         ///< C, m
  Eigen::VectorXd restitution = {};  ///< C, e_c, 0..1

  /// The same over so many of its periods.
  ImpactsProblem over_periods(int times) const;
  /// Throws std::invalid_argument for sizes that do not fit, numbers out of their range, structural damping,
  /// a structure that is free to move, and a contact without mass, which has no impacts.
  void validate() const;
};

/// C x C, 1/kg: S M^-1 S^T, the velocities of the contacts by impulses of 1 N s. O(C^2 poles).
Eigen::MatrixXd inverse_contact_mass(const ContactDynamics& dynamics);

/// What impacts take of a problem, at its frequency and load. Throws as ImpactsProblem::validate() does.
/// O(n^3) for each harmonic of the load.
ImpactsProblem impacts_problem(const CondensedProblem& problem, const ContactDynamics& dynamics,
                               const Eigen::VectorXd& gaps, const Eigen::VectorXd& restitution);

}  // namespace wavebalance::solvers
