#pragma once
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace wavebalance::solvers {

/// Options of the search for a motion of several forcing periods.
struct SubharmonicOptions {
  ForcedResponseOptions response;
  FloquetOptions floquet;             ///< of the perturbations
  double tolerance = largest_change;  ///< of motion_periods()

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A response of a problem whose load repeats load_periods() = n times within its period, as
/// forced_response() with its start and options, that repeats after no fewer than n periods of the load if
/// such a motion is found. A motion of fewer periods satisfies the same equations, so motion_periods() of
/// the result identifies it. In this order Newton's method starts from
///
/// - what forced_response() starts from;
/// - the attractor found by settle(), if that has no fewer periods;
/// - the motion found, with perturbations of it that grow or decay over n periods without a change of phase,
///   by floquet_exponents(): at a period doubling the null vector. `dynamics` has the structure; none leaves
///   this out. Where Newton's method finds no other motion so, the curve of motions with that perturbation is
///   followed from the frequency at which one of them is near.
///
/// With n = 1 it is forced_response(). Throws std::invalid_argument as that does.
PeriodicResponse subharmonic_response(CondensedProblem& problem, const ContactLaws& laws,
                                      const ContactDynamics* dynamics, const SubharmonicOptions& options,
                                      const Eigen::VectorXd& guess = {});

}  // namespace wavebalance::solvers
