#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::solvers {

/// How a motion is integrated from rest until it repeats.
struct SettlingOptions {
  int steps = 1024;         ///< per period of the load
  int max_periods = 600;    ///< of the load
  int longest = 16;         ///< periods of the load after which a motion may repeat
  double tolerance = 1e-6;  ///< of the state after its period, in the energy norm, relative
  int max_modes = 120;      ///< of the structure; the others deflect statically
  int max_size = 400;       ///< degrees of freedom up to which the modes are computed
  Observer observer;        ///< called once per period

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The motion that a structure at rest settles to under its load.
struct SettledMotion {
  static constexpr int not_integrated = -1;
  /// Periods of the load after which the motion repeats: 1 for a motion of the load's period, 2, 3, ... for
  /// subharmonic ones, 0 for none within the options' limits, -1 when nothing could be integrated.
  int attractor_periods = not_integrated;
  int periods = 0;         ///< integrated
  bool cancelled = false;  ///< the observer asked to stop
  double start = 0.0;      ///< periods of the problem after t = 0 at which the columns begin
  /// C x steps load_periods(), m and N: of the last period of the problem.
  Eigen::MatrixXd displacement, force;
};

/// Integrates M u'' + C u' + K u = load - contact forces of `problem` (frequency set before) from rest at a
/// maximum of the load's first harmonic. Each
/// step is exact for forces linear in time; the forces at its end are solved for with the resolvents of the
/// laws, so that any law serves, rigid ones too [M. Jean, Comput. Methods Appl. Mech. Eng. 177, 1999].
/// Second order in the step. O(n^3) once, O(m^2 + C m) per step.
SettledMotion settle(const CondensedProblem& problem, const ContactLaws& laws,
                     const SettlingOptions& options = {});

/// A row per contact of values at uniform steps of the period from `start` (periods) on, interpolated
/// linearly at `points` points from t = 0 on: the samples of a problem whose first one is there,
/// contact-major.
Eigen::VectorXd resample(const Eigen::MatrixXd& by_contact, int points, double start = 0.0);

}  // namespace wavebalance::solvers
