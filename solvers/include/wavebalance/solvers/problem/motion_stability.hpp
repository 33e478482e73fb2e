#pragma once
#include <complex>
#include <string>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {

/// The stability of a motion.
struct MotionStability {
  /// "stable", "unstable", or why it is not known: a StabilityStatus, "no_modes" of the structure, or
  /// "not_found" of a ExactStatus.
  std::string status = "no_modes";
  int unstable = -1;  ///< Floquet multipliers outside the unit circle; -1 where not known
  /// The multiplier of the largest modulus, Im >= 0, of several the one with the largest real part; NaN where
  /// it is not known or below 1e-2.
  std::complex<double> leading{missing, missing};
  double leading_error = 0.0;  ///< estimated, where refining it would cost too much
  /// Whether it belongs to the exact motion or to the balance.
  bool is_exact = false;
  double wall_seconds = 0.0;
};

/// Default options for the stability of a problem's motions: as many harmonics as the trial functions, at
/// most 255, since 127 already give exponents to 1e-6 and the cost grows like their cube; the monodromy of
/// up to 120 states where contact is too stiff for the harmonics, since it costs seconds with many;
/// operations of about ten seconds.
StabilityOptions stability_options(const CondensedProblem& problem);

/// The verdict on a motion of which all multipliers are known, the largest first.
MotionStability stability_of_multipliers(const Eigen::VectorXcd& multipliers);

/// The stability of a response, at whose frequency and load the problem is. By the contact intervals of
/// `motion` where these are known: all multipliers at once, ExactSolution::multipliers(), which have no
/// harmonics to truncate. Where none was found near the response there is no verdict. `motion` may be
/// null.
MotionStability motion_stability(const CondensedProblem& problem, const ContactLaws& laws,
                                 const PeriodicResponse& response, const ContactDynamics& dynamics,
                                 const ExactSolution* motion = nullptr);

}  // namespace wavebalance::solvers
