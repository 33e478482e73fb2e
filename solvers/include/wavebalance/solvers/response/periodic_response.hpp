#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/balance/newton.hpp"
#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

namespace wavebalance::solvers {

/// A periodic response at one frequency, as the solvers leave it. Displacement and force are the unknown of
/// the balance at the quadrature points and therefore vectors, contact-major like every vector of samples; so
/// they also serve as the start of another solve. contact_motion() makes them a Motion at any points.
struct PeriodicResponse {
  SolveStatus status = SolveStatus::iteration_limit;
  double frequency = 0.0;                ///< Hz
  double residual = 0.0;                 ///< ||R|| / (||u0|| + ||K f||)
  int iterations = 0;                    ///< Newton iterations, and pivots of complementarity paths
  Strategy strategy = Strategy::none;    ///< what found it
  std::vector<double> residual_history;  ///< residuals of the last Newton run
  double condition = 0.0;                ///< NewtonResult::condition of that run
  Eigen::VectorXd displacement;          ///< m, samples() values, contact-major
  Eigen::VectorXd contact_force;         ///< N, samples() values
  /// Whether contact_force is the force in the balance rather than the law's force at the displacement. This
  /// is so for a law whose penetration is below rounding of the displacement. The law is then satisfied in
  /// displacement, to 1e-9 of the motion, and `residual` is that mismatch. It is always so for rigid
  /// obstacles, which have no law.
  bool force_by_balance = false;
  Eigen::MatrixXcd coefficients;  ///< (M/2 + 1) x C, spectra over translates of the trial coefficients

  bool converged() const { return status == SolveStatus::converged; }
};

}  // namespace wavebalance::solvers
