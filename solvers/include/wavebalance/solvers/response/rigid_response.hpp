#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

/// Violation of u <= gap, force >= 0 and product 0 at the samples, over all contacts.
struct Complementarity {
  double max_penetration = 0.0;  ///< max(u - gap), m; negative when nothing touches
  double min_force = 0.0;        ///< N
  /// max |force (gap - u)| over max force and the larger of max |gap - u| and max |u|; 0 without contact.
  double product = 0.0;
};

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                double gap);
/// The same for contacts with one gap each, samples contact-major.
Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                const Eigen::VectorXd& gaps);

/// When a response counts as one with rigid contact, and limits of its solution.
struct RigidResponseOptions {
  /// Penetration at the N points that counts as rigid, over the largest of |u0| and u0 - gap.
  double tolerance = 1e-6;
  ComplementarityOptions paths;
  Observer observer;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A response with rigid (Signorini) contact. `response.status` is converged only when complementarity holds
/// at every sample of every contact to the tolerance. Otherwise the response is that of the stiffest obstacle
/// solved for.
struct RigidResponse {
  PeriodicResponse response;
  Complementarity complementarity;                       ///< overall
  std::vector<Complementarity> contact_complementarity;  ///< one entry per contact
  double stiffness = 0.0;  ///< N/m of the last obstacle; infinity when the active set was solved exactly
  int active_samples = 0;
};

/// The periodic response of `problem` (frequency set before) against rigid obstacles at `gaps`, one per
/// contact and of any sign:
///
///   u = u0 - K force,   gap - u >= 0,   force >= 0,   product 0   at all samples.
///
/// An active set started from the contact-free response cycles in nearly every case. Instead, obstacles with
/// a small flexibility are lowered and stiffened along piecewise linear paths. Their active samples are then
/// solved with u = gap, which is accepted when every sign holds. With as many points as functions there may
/// be no solution, or several. Throws std::invalid_argument for gaps that are not finite or not one per
/// contact. O(pivots (active^2 + C N log N + C^2 M)).
RigidResponse rigid_response(CondensedProblem& problem, const Eigen::VectorXd& gaps,
                             const RigidResponseOptions& options);
/// With one gap for all contacts.
RigidResponse rigid_response(CondensedProblem& problem, double gap, const RigidResponseOptions& options);

}  // namespace wavebalance::solvers
