#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/contact_form.hpp"
#include "wavebalance/solvers/continuation/residual_homotopy.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// Options of a forced response.
struct ForcedResponseOptions {
  NewtonOptions newton;
  ContactForm form = ContactForm::automatic;
  /// Whether more than Newton's method from the start is tried, see Strategy.
  bool fallbacks = true;
  /// Whether what is tried after Newton's method starts from the guess, too: a residual homotopy from there
  /// instead of all other strategies, so that the response is near the guess or missing. Without effect
  /// where there is no guess.
  bool stay_near_guess = false;
  double max_fallback_operations = 1e10;  ///< of each further Newton run; 20 iterations at least
  AttractorOptions settling;              ///< its observer is not used
  ResidualHomotopyOptions continuation;   ///< in the gaps and of residuals; its observer is not used
  Observer observer;                      ///< called in all steps; NewtonOptions::observer is not used here

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The periodic response of `problem` (frequency set before) under `laws`, one for all contacts or one for
/// each, from the linear response or from `guess` (samples() values, m) when it is not empty. The force
/// form also starts from `guess_force` (samples() values, N), the contact force of the guess, zero when it is
/// empty. If it does not converge, the status gives the
/// reason. A structure that is free to move starts at the position in which
/// the mean contact forces balance its static load; its status is unbalanced where no such forces exist.
/// Throws std::invalid_argument for guesses or a list of laws of another length, for a problem without
/// frequency, for rigid laws at contacts with mass and for options out of range; and, where it does not
/// converge, for a law that returns no number at the linear response or the last iterate,
/// ContactLaws::require_numbers().
PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess = {},
                                 const Eigen::VectorXd& guess_force = {});

}  // namespace wavebalance::solvers
