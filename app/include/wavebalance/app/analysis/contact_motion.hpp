#pragma once
#include <Eigen/Core>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/solvers/reference/period_samples.hpp"

namespace wavebalance::app {

/// The motion of all contact degrees of freedom over one period, contacts x points each: towards their
/// obstacles (m, m/s) and the contact forces (N). Empty if there is no motion.
struct ContactMotion {
  Eigen::MatrixXd displacement, velocity, force;

  int contacts() const { return static_cast<int>(displacement.rows()); }
  int points() const { return static_cast<int>(displacement.cols()); }
  /// The contact with the largest force; without any force, the one that comes nearest to its gap (m, one a
  /// contact). From 0.
  int leading(const Eigen::VectorXd& gaps) const;
  /// That of contact-major samples.
  static ContactMotion of(const solvers::PeriodSamples& samples);
  /// Time histories of one contact.
  solvers::PeriodSamples samples(int contact) const;
};

/// time_fraction, contact (from 1), displacement_m, contact_force_N: every contact at every time.
Table contacts_table(const ContactMotion& motion);

}  // namespace wavebalance::app
