#pragma once
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"

namespace wavebalance::solvers {

/// Whether mean contact forces exist that balance the static load of a structure that is free to move, forces
/// of at least zero where a law is unilateral [Farkas' lemma; Lawson & Hanson]. Without them no periodic
/// motion exists. O(C q^2 + q^4) for q rigid motions.
bool static_load_is_balanced(const CondensedProblem& problem, const ContactLaws& laws);

/// A motion to start from, samples() values each: that without contact, or its mean, at the position in which
/// the mean forces of the laws balance the static load.
struct BalancedMotion {
  Eigen::VectorXd displacement;  ///< m
  Eigen::VectorXd force;         ///< N
};

/// `series_flexibility` as of ContactOperator; rigid laws need it. Not `moving` is the
/// mean. Each rigid motion in turn by bisection. O(C N) per step.
BalancedMotion balanced_motion(const CondensedProblem& problem, const ContactLaws& laws,
                               const Eigen::VectorXd& series_flexibility, bool moving);

}  // namespace wavebalance::solvers
