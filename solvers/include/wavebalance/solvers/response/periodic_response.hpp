#pragma once
#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_system.hpp"
#include "wavebalance/solvers/balance/newton.hpp"

namespace wavebalance::solvers {

struct AttractorMotion;

/// Strategies for a periodic response, in the order in which they are tried.
enum class Strategy {
  none,    ///< no response was found
  newton,  ///< Newton's method from the start given, or no contact at all
  /// Newton's method at growing shares of the contact force, from the motion without contact
  stiffness_continuation,
  gap_continuation,   ///< arc length in the gaps, from where the first contact touches to the gaps given
  load_continuation,  ///< growing loads, from rest; contacts that are closed there are springs of the
                      ///< structure
  sticking,           ///< Newton's method from the motion in which all contacts with friction stick
  settling,           ///< Newton's method from the motion that the structure at rest converges to
  recurrence,         ///< Newton's method from a period after which that motion nearly returns
  residual_homotopy,  ///< arc length from that motion, or from the start given, to a solution
  perturbation        ///< Newton's method from a motion of fewer periods and a perturbation of it
};

std::string_view to_string(Strategy strategy);

/// A periodic response at one frequency, as the solvers leave it. Displacement and force are those at the
/// quadrature points and therefore vectors, contact-major like every vector of samples; so they also serve as
/// the start of another solve. contact_motion() makes them a Motion at any points.
struct PeriodicResponse {
  SolveStatus status = SolveStatus::iteration_limit;
  double frequency = 0.0;              ///< Hz
  double load_scale = 1.0;             ///< CondensedProblem::load_scale()
  double residual = 0.0;               ///< ||R|| / (||u0|| + ||K f||)
  int iterations = 0;                  ///< Newton iterations of all attempts
  Strategy strategy = Strategy::none;  ///< what found it
  /// AttractorMotion::attractor_periods if an attractor was computed; -1 otherwise.
  int attractor_periods = -1;
  /// That attractor.
  std::shared_ptr<const AttractorMotion> settled;
  std::vector<double> residual_history;  ///< residuals of the last Newton run
  double condition = 0.0;                ///< NewtonResult::condition of that run
  /// Estimated rounding error of the condensation in the motion, relative: CondensedProblem::rounding_error()
  /// and, where that exceeds 1e-6, the error that contact makes of it, J^-1 times the errors.
  double rounding_error = 0.0;
  Eigen::VectorXd displacement;   ///< m, samples() values, contact-major
  Eigen::VectorXd contact_force;  ///< N, samples() values
  /// CondensedProblem::force_on_held_structure(), N, samples() values, the force in the condensed equations.
  /// It equals contact_force unless the structure is free to move.
  Eigen::VectorXd force_on_held_structure;
  Eigen::MatrixXcd coefficients;  ///< (M/2 + 1) x C, spectra over translates of the trial coefficients
  /// 1 / epsilon of each contact (m/N) in the force form; empty in the displacement form.
  Eigen::VectorXd series_flexibility;
  Eigen::VectorXd unknown;                ///< m, samples() values: displacement, or v of the force form
  Eigen::MatrixXcd unknown_coefficients;  ///< as coefficients, for the unknown

  bool converged() const { return status == SolveStatus::converged; }
};

/// The response at `unknown`, a solution of the system at the frequency and in the form of its problem, as
/// a point of a curve is. Its status is converged; members about the search keep their defaults. O(C N log
/// N).
PeriodicResponse response_at(ContactSystem& system, Eigen::VectorXd unknown);

}  // namespace wavebalance::solvers
