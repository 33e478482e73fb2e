#pragma once
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// The motion of the structure near a response of a balance, and the distance between the two.
struct ExactNearResponse {
  ExactSolution motion;
  /// Relative rms errors of the response's displacements and forces over all contacts and the period; NaN
  /// without a motion, and of the force where none acts.
  double displacement_error, force_error;
};

/// Input of collocation_motion() for a problem at its frequency and load. `dynamics` belong to its
/// structure. O(n^3) for each harmonic of the load.
ExactProblem exact_problem(const CondensedProblem& problem, const ContactLaws& laws,
                           const ContactDynamics& dynamics);

/// Solver for an exact motion from displacements and forces of the contacts, as collocation_motion().
using IntervalFinder = ExactSolution (*)(const ExactProblem& problem, const Eigen::MatrixXd& start,
                                         const CollocationOptions& options,
                                         const Eigen::MatrixXd& start_force);

/// collocation_motion() from a response of `problem` to `laws`, at the frequency and load of the problem,
/// or `find` instead. `dynamics` belong to its structure. O(n^3) for each harmonic of the load, in addition
/// to collocation_motion().
ExactNearResponse exact_near_response(const CondensedProblem& problem, const ContactLaws& laws,
                                      const PeriodicResponse& response, const ContactDynamics& dynamics,
                                      const CollocationOptions& options = {},
                                      IntervalFinder find = collocation_motion);

/// The same for what exact_problem() gives at the frequency and load of the problem.
ExactNearResponse exact_near_response(const CondensedProblem& problem, const PeriodicResponse& response,
                                      const ExactProblem& exact, const CollocationOptions& options = {},
                                      IntervalFinder find = collocation_motion);

}  // namespace wavebalance::solvers
