#pragma once
#include <Eigen/Core>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// The contact with the largest force; without any force, the one that comes nearest to its gap (m, one per
/// contact). From 0; 0 of an empty motion.
int leading_contact(const solvers::Motion& contacts, const Eigen::VectorXd& gaps);

/// time_fraction, displacement_m, velocity_m_per_s, contact_force_N of one contact, 1 x points each.
Table response_table(const solvers::Motion& contact);

/// time_fraction, contact (from 1), displacement_m, contact_force_N: every contact at every time.
Table contacts_table(const solvers::Motion& contacts);

}  // namespace wavebalance::app
