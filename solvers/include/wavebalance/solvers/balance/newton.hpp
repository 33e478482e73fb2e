#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/solvers/balance/contact_system.hpp"

namespace wavebalance::solvers {

enum class SolveStatus {
  converged,        ///< the residual meets the tolerance
  stalled,          ///< no descent along the Newton direction, and the homotopy did not get through either
  iteration_limit,  ///< iterations used up
  singular          ///< the Newton matrix is singular, or so nearly that GMRES gets nowhere
};

std::string to_string(SolveStatus status);

struct NewtonOptions {
  double tolerance = 1e-11;  ///< on ||R|| / (||u0|| + ||K f||)
  int max_iterations = 60;
  double smallest_step = 1.0 / 4096;  ///< of the line search, relative to the Newton step
  LinearSolver linear_solver = LinearSolver::automatic;
};

struct NewtonResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  double residual = 0.0;                 ///< relative, see NewtonOptions
  std::vector<double> residual_history;  ///< one entry an iteration, the first before any step
  /// Condition number of the last Newton matrix on the active samples: with LU an estimate in the 1-norm,
  /// with GMRES a lower bound in the 2-norm from vectors that were multiplied. 0 when no system was solved,
  /// infinite when a pivot vanished.
  double condition = 0.0;
};

/// Semismooth Newton with line search on ||R||^2 from the displacement samples in `u`, which it improves in
/// place and leaves at the smallest residual found. O(active^3 + N log N) an iteration, or with GMRES for
/// many active samples O(N log N) a product, a few products an iteration.
NewtonResult newton(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options);

}  // namespace wavebalance::solvers
