#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/safe_norm.hpp"
#include "wavebalance/solvers/balance/newton.hpp"

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
  const double start = safe_norm(system.residual());
  const Eigen::VectorXd base = u;
  for (double step = 1.0; step >= options.smallest_step; step *= 0.5) {
    u = base - step * direction;
    system.evaluate(u);
    if (safe_norm(system.residual()) <= std::sqrt(1.0 - 2.0 * sufficient * step) * start) return true;
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

// Bounds of force_defect(): what is sought, and beyond which a stiff law has made too much of a small
// residual.
constexpr double sought_defect = 1e-9, largest_defect = 1e-7;

// The force makes the motion u - R, whose own force is f - D R, and u is rounded: how far the law's force at
// the motion may be from the force that makes it, over the largest force, times the share that it has in the
// motion.
double force_defect(ContactSystem& system, const Eigen::VectorXd& u) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double largest = system.force().cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return 0.0;
  const Eigen::VectorXd& free = system.problem().free_response();
  const double share = safe_norm(u - free) / (safe_norm(u) + safe_norm(free));
  const auto error = system.residual().cwiseAbs() + eps * u.cwiseAbs();
  return share * system.tangent().cwiseProduct(error).maxCoeff() / largest;
}

NewtonResult iterate(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options) {
  NewtonResult result;
  Eigen::VectorXd direction;
  double before = std::numeric_limits<double>::infinity();
  const auto ended = [&](SolveStatus otherwise) {
    const bool good = result.residual <= options.tolerance && force_defect(system, u) <= largest_defect;
    result.status = good ? SolveStatus::converged : otherwise;
    return result;
  };
  system.evaluate(u);
  for (;; ++result.iterations) {
    result.residual = system.relative_residual();
    result.residual_history.push_back(result.residual);
    const bool settled = result.residual > 0.5 * before || force_defect(system, u) <= sought_defect;
    if (result.residual <= options.tolerance && settled) return ended(SolveStatus::stalled);
    before = result.residual;
    if (result.iterations >= options.max_iterations) return ended(SolveStatus::iteration_limit);
    const double reduction = forcing_term(result.residual, options.tolerance);
    if (!system.factorize()) {
      result.condition = std::numeric_limits<double>::infinity();
      return ended(SolveStatus::singular);
    }
    if (!system.solve(system.residual(), direction, reduction)) return ended(SolveStatus::singular);
    if (!line_search(system, u, direction, options)) return ended(SolveStatus::stalled);
  }
}

}  // namespace

NewtonResult newton(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options) {
  system.set_linear_solver(options.linear_solver);
  NewtonResult result = iterate(system, u, options);
  const bool factorized = result.iterations > 0 || result.status == SolveStatus::stalled ||
                          result.status == SolveStatus::singular;
  if (factorized && std::isfinite(result.condition)) result.condition = system.condition();
  return result;
}

}  // namespace wavebalance::solvers
