#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/balance/newton.hpp"
#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

namespace wavebalance::solvers {

/// A periodic response at one frequency, as the solvers leave it. Displacement and force are those at the
/// quadrature points and therefore vectors, contact-major like every vector of samples; so they also serve as
/// the start of another solve. contact_motion() makes them a Motion at any points.
struct PeriodicResponse {
  SolveStatus status = SolveStatus::iteration_limit;
  double frequency = 0.0;              ///< Hz
  double residual = 0.0;               ///< ||R|| / (||u0|| + ||K f||)
  int iterations = 0;                  ///< Newton iterations and pivots of all attempts
  Strategy strategy = Strategy::none;  ///< what found it
  /// SettledMotion::attractor_periods where the structure was settled; -1 where it was not.
  int attractor_periods = -1;
  std::vector<double> residual_history;  ///< residuals of the last Newton run
  double condition = 0.0;                ///< NewtonResult::condition of that run
  Eigen::VectorXd displacement;          ///< m, samples() values, contact-major
  Eigen::VectorXd contact_force;         ///< N, samples() values
  Eigen::MatrixXcd coefficients;         ///< (M/2 + 1) x C, spectra over translates of the trial coefficients
  /// 1 / epsilon of each contact (m/N) in the force form; empty in the displacement form.
  Eigen::VectorXd regularization;
  Eigen::VectorXd unknown;                ///< m, samples() values: displacement, or v of the force form
  Eigen::MatrixXcd unknown_coefficients;  ///< as coefficients, for the unknown
  /// Whether contact_force is the force in the balance rather than the law's force at the displacement. This
  /// is so for a law whose penetration is below rounding of the displacement. The law is then satisfied in
  /// displacement, to 1e-9 of the motion, and `residual` is that mismatch.
  bool force_by_balance = false;

  bool converged() const { return status == SolveStatus::converged; }
};

}  // namespace wavebalance::solvers
