#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>

#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// Told after each iteration or homotopy step: what is done, how often, and the current relative residual.
/// Returns false to stop.
using SolveObserver = std::function<bool(const std::string& phase, int step, double residual)>;

struct ForcedResponseOptions {
  NewtonOptions newton;
  /// When Newton stalls: by complementarity, and then along the solution in the contact stiffness by arc
  /// length.
  bool homotopy = true;
  int homotopy_steps = 2000;  ///< of the arc length, at most
  SolveObserver observer;
};

/// The periodic response of `problem` (frequency set before) under `laws`, one for all contacts or one each,
/// from the contact-free response or from `guess` (samples() values) when it is not empty. Never throws for
/// want of convergence: read the status. Throws std::invalid_argument for a guess or a list of laws of
/// another length and for a problem without frequency.
PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess = {});

}  // namespace wavebalance::solvers
