#include <algorithm>
#include <cmath>

#include "wavebalance/solvers/forced_response.hpp"

namespace wavebalance::solvers {

std::string to_string(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return "converged";
    case SolveStatus::stalled:
      return "stalled";
    case SolveStatus::iteration_limit:
      return "iteration_limit";
    case SolveStatus::singular:
      return "singular";
  }
  return "unknown";
}

namespace {

// Armijo backtracking on ||R||^2. True when a step was taken; the system is then evaluated at the new u.
bool line_search(ContactSystem& system, Eigen::VectorXd& u, const Eigen::VectorXd& direction,
                 const NewtonOptions& options) {
  constexpr double sufficient = 1e-4;
  const double start = system.residual().squaredNorm();
  const Eigen::VectorXd base = u;
  for (double step = 1.0; step >= options.smallest_step; step *= 0.5) {
    u = base - step * direction;
    system.evaluate(u);
    if (system.residual().squaredNorm() <= (1.0 - 2.0 * sufficient * step) * start) return true;
  }
  u = base;
  system.evaluate(u);
  return false;
}

// Residual to which a Newton system is solved by iteration: so small that the active sets, and with them the
// steps, are those of exact solves, and not below what the tolerance asks for.
double forcing_term(double residual, double tolerance) {
  constexpr double exact_enough = 1e-6, share = 0.1, least = 1e-12;
  return std::max({least, share * tolerance / residual, exact_enough * std::min(1.0, 100.0 * residual)});
}

NewtonResult iterate(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options) {
  NewtonResult result;
  Eigen::VectorXd direction;
  system.evaluate(u);
  for (;; ++result.iterations) {
    result.residual = system.relative_residual();
    result.residual_history.push_back(result.residual);
    if (result.residual <= options.tolerance) {
      result.status = SolveStatus::converged;
      return result;
    }
    if (result.iterations >= options.max_iterations) return result;
    const double reduction = forcing_term(result.residual, options.tolerance);
    if (!system.factorize() || !system.solve(system.residual(), direction, reduction)) {
      result.status = SolveStatus::singular;
      return result;
    }
    if (!line_search(system, u, direction, options)) {
      result.status = SolveStatus::stalled;
      return result;
    }
  }
}

}  // namespace

NewtonResult newton(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options) {
  system.set_linear_solver(options.linear_solver);
  NewtonResult result = iterate(system, u, options);
  if (result.iterations > 0) result.condition = system.condition();
  return result;
}

}  // namespace wavebalance::solvers
