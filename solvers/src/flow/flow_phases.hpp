#pragma once
#include "wavebalance/solvers/flow/contact_flow.hpp"

namespace wavebalance::solvers::detail {

/// A period of a flow that began `begin` periods after time 0, as a periodic motion with its phases, contacts
/// with friction and parts.
PhaseMotion motion_of(const PhasesProblem& problem, const ContactFlow& flow, double begin);

/// Gives such a motion its multipliers.
void set_multipliers(PhaseMotion& motion, Eigen::VectorXcd multipliers);

}  // namespace wavebalance::solvers::detail
