#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/complementarity/complementarity_options.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// How a forced response is sought.
struct ForcedResponseOptions {
  NewtonOptions newton;
  /// Whether the complementarity problem of the contact forces is solved when Newton does not converge.
  bool complementarity = true;
  ComplementarityOptions paths;
  Observer observer;  ///< called by Newton and by the paths; NewtonOptions::observer is not used here

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The periodic response of `problem` (frequency set before) under `laws`, one for all contacts or one for
/// each, from the contact-free response or from `guess` (samples() values, m) when it is not empty. If it
/// does not converge, the status gives the reason. Throws std::invalid_argument for a guess or a list of laws
/// of another length, for a problem without frequency and for options out of range.
PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess = {});

}  // namespace wavebalance::solvers
