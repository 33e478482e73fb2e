#pragma once
#include "wavebalance/solvers/flow/contact_flow.hpp"

namespace wavebalance::solvers::detail {

/// The period of a flow from a start as a periodic motion with its intervals, contacts with friction, impacts
/// and parts.
ExactSolution motion_of(const ExactProblem& problem, const ContactFlow& flow, const PeriodStart& start);

/// The impacts of its last period, by time.
std::vector<Impact> impacts_of(const ContactFlow& flow, double begin);

/// ContactFlow::state() by ContactDynamics::poles().
Eigen::VectorXcd states_by_pole(const ContactDynamics& dynamics, const Eigen::VectorXd& state);

/// Gives such a motion its multipliers.
void set_multipliers(ExactSolution& motion, Eigen::VectorXcd multipliers);

}  // namespace wavebalance::solvers::detail
