#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// The motion of all contacts in a response of `problem` to `laws`, at `points` uniform times as in the
/// constructor of MotionEvaluator: displacement and velocity from the response's coefficients, forces by the
/// laws from the displacements, or in the force form by their resolvents from the unknown. O(C points log
/// points).
Motion contact_motion(const CondensedProblem& problem, const PeriodicResponse& response,
                      const ContactLaws& laws, int points);

/// The motion of all n degrees of freedom, without forces, in a response of `problem`, whose load scale
/// must equal the response's. Throws std::invalid_argument where the problem is at another frequency, and
/// SingularSystem. O(n (M + points log points)).
Motion structure_motion(CondensedProblem& problem, const PeriodicResponse& response, int points);

/// E = u'^T M u' / 2 + u^T K u / 2 + the potentials of all contacts, J, at each point [JL14, eq. (35)], of a
/// motion of all n degrees of freedom.
/// Throws std::invalid_argument for laws that are neither one nor one per contact. O(n points).
Eigen::VectorXd system_energy(const LinearStructure& structure, const ContactLaws& laws,
                              const Motion& motion);

/// The rms of the system energy over the period, J: the paper's energy norm before it is normalised.
double energy_norm(const LinearStructure& structure, const ContactLaws& laws, const Motion& motion);

}  // namespace wavebalance::solvers
