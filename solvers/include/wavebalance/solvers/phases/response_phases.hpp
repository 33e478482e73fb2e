#pragma once
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// The motion of the structure near a response of a balance, and the distance between the two.
struct ResponsePhases {
  PhaseMotion motion;
  /// Relative rms errors of the response's displacements and forces over all contacts and the period; NaN
  /// without a motion, and of the force where none acts.
  double displacement_error, force_error;
};

/// What contact_phases() takes of a problem at its frequency and load. `dynamics` are those of its structure.
/// O(n^3) for each harmonic of the load.
PhasesProblem phases_problem(const CondensedProblem& problem, const ContactLaws& laws,
                             const ContactDynamics& dynamics);

/// Solver for an exact motion from displacements and forces of the contacts, as contact_phases().
using PhaseFinder = PhaseMotion (*)(const PhasesProblem& problem, const Eigen::MatrixXd& start,
                                    const ContactPhasesOptions& options, const Eigen::MatrixXd& start_force);

/// contact_phases() from a response of `problem` to `laws`, at the frequency and load of the problem, or what
/// `find` does in its place. `dynamics` are those of its structure. O(n^3) for each harmonic of the load,
/// beside what contact_phases() takes.
ResponsePhases response_phases(const CondensedProblem& problem, const ContactLaws& laws,
                               const PeriodicResponse& response, const ContactDynamics& dynamics,
                               const ContactPhasesOptions& options = {}, PhaseFinder find = contact_phases);

/// The same for what phases_problem() gives at the frequency and load of the problem.
ResponsePhases response_phases(const CondensedProblem& problem, const PeriodicResponse& response,
                               const PhasesProblem& phases, const ContactPhasesOptions& options = {},
                               PhaseFinder find = contact_phases);

}  // namespace wavebalance::solvers
