#include "response/stiffness_continuation.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr double largest_ratio = 16.0, least_ratio = 1.05;  // of successive shares
constexpr int quick = 5, most = 12;                         // iterations at a share

// The share of the force at which the contacts move the structure by half of its motion without them; not
// finite where the force there is not.
double first_share(ContactSystem& system, const Eigen::VectorXd& free) {
  constexpr double part = 0.5;
  system.evaluate(free);
  const double moved = safe_norm(system.residual());
  return moved > 0.0 ? std::min(1.0, part * safe_norm(free) / moved) : 1.0;
}

StiffnessPath follow(ContactSystem& system, Eigen::VectorXd& u, NewtonOptions options) {
  StiffnessPath path;
  u = system.problem().linear_response();
  double solved = 0.0, share = first_share(system, u), ratio = largest_ratio;
  if (!(share > 0.0)) return path;
  options.max_iterations = std::min(options.max_iterations, most);
  const double limit = system.operations() + options.max_operations;
  while (ratio >= least_ratio) {
    system.set_force_share(share);
    Eigen::VectorXd next = u;
    options.max_operations = limit - system.operations();
    path.status = options.max_operations > 0.0 ? SolveStatus::stalled : SolveStatus::effort_limit;
    if (path.status == SolveStatus::effort_limit) return path;
    const NewtonResult found = newton(system, next, options);
    path.iterations += found.iterations;
    path.status = found.status;
    if (found.status == SolveStatus::cancelled) return path;
    if (found.status == SolveStatus::converged) {
      u = std::move(next);
      solved = share;
      if (solved == 1.0) return path;
      if (found.iterations <= quick) ratio = std::min(largest_ratio, ratio * ratio);
      share = std::min(1.0, solved * ratio);
    } else {
      ratio = std::sqrt(ratio);
      share = solved > 0.0 ? std::min(1.0, solved * ratio) : share / largest_ratio;
    }
  }
  return path;
}

}  // namespace

StiffnessPath follow_stiffness(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options) {
  const StiffnessPath path = follow(system, u, options);
  system.set_force_share(1.0);
  return path;
}

}  // namespace wavebalance::solvers::detail
