#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "wavebalance/solvers/contact_system.hpp"

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

/// A periodic response at one frequency.
struct PeriodicResponse {
  SolveStatus status = SolveStatus::iteration_limit;
  double frequency = 0.0;  ///< Hz
  double residual = 0.0;   ///< ||R|| / (||u0|| + ||K f||)
  int iterations = 0;      ///< Newton iterations, steps and corners of the homotopies included
  bool used_homotopy = false;
  std::vector<double> residual_history;  ///< of the last Newton run
  double condition = 0.0;                ///< of its last Newton matrix, see NewtonResult
  Eigen::VectorXd displacement;          ///< m, samples() values, contact-major
  Eigen::VectorXd contact_force;         ///< N, samples() values
  /// Whether contact_force is what makes the motion and not the law's at it: a law so stiff that
  /// displacements do not resolve its penetration is met in displacement, to 1e-9 of the motion, which
  /// `residual` then says.
  bool force_by_balance = false;
  Eigen::MatrixXcd coefficients;  ///< (M/2 + 1) x C, spectra over translates of the trial coefficients

  bool converged() const { return status == SolveStatus::converged; }
};

/// The periodic response of `problem` (frequency set before) under `laws`, one for all contacts or one each,
/// from the contact-free response or from `guess` (samples() values) when it is not empty. Never throws for
/// want of convergence: read the status. Throws std::invalid_argument for a guess or a list of laws of
/// another length and for a problem without frequency.
PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess = {});

}  // namespace wavebalance::solvers
