#pragma once
#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_system.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::solvers {

/// How a solve ended.
enum class SolveStatus {
  converged,        ///< the residual meets the tolerance
  stalled,          ///< no descent along the Newton direction, and no complementarity path led to a solution
  iteration_limit,  ///< max_iterations was reached
  effort_limit,     ///< the limit of operations was reached
  singular,         ///< the Newton matrix is singular, or so nearly that GMRES does not converge
  unbalanced,       ///< nothing balances the static load of a structure that is free to move
  inaccurate,       ///< converged, but ContactProblem finds the rounding errors of the condensation too large
  cancelled         ///< the observer returned false
};

std::string_view to_string(SolveStatus status);

/// When a Newton iteration ends.
struct NewtonOptions {
  double tolerance = 1e-11;      ///< on ||R|| / (||u0|| + ||K f||)
  int max_iterations = 60;       ///< 0 only evaluates the start
  double min_step = 1.0 / 4096;  ///< least step of the line search, relative to the Newton step
  /// Past residuals of which a step has to undercut the largest; with 1 each residual is below the last.
  int memory = 1;
  double max_operations = 1e11;  ///< of linear systems and products; 1e10 take about a second
  LinearSolver linear_solver = LinearSolver::automatic;
  Observer observer;  ///< called before each iteration

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// How a Newton iteration ended.
struct NewtonResult {
  SolveStatus status = SolveStatus::iteration_limit;
  int iterations = 0;
  double residual = 0.0;                 ///< relative, see NewtonOptions
  std::vector<double> residual_history;  ///< one entry per iteration, the first before any step
  /// Condition number of the last Newton matrix on the active samples: with LU an estimate in the 1-norm,
  /// with GMRES a lower bound in the 2-norm from vectors that were multiplied. 0 when no system was solved,
  /// infinite when a pivot vanished.
  double condition = 0.0;
};

/// Semismooth Newton iteration (L. Qi, J. Sun, Math. Program. 58, 1993, doi:10.1007/BF01581275) with a line
/// search on ||R||^2 from the displacement samples in `u`. `u` is changed in place and holds the last
/// iterate. O(active^3 + N log N) per iteration, or with GMRES for many active samples O(N
/// log N) per product, with a few products per iteration. Throws what NewtonOptions::validate throws.
NewtonResult newton(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options);

}  // namespace wavebalance::solvers
