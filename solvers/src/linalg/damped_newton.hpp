#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <deque>

namespace wavebalance::solvers::detail {

/// A system of equations F(x) = 0 for damped_newton().
template <class System>
concept DampedNewtonSystem = requires(System system, Eigen::VectorXd vector) {
  /// Evaluates F at a state and returns its norm.
  { system.evaluate(vector) } -> std::convertible_to<double>;
  /// That norm.
  { system.norm() } -> std::convertible_to<double>;
  /// Whether the state last evaluated is a solution.
  { system.is_solved() } -> std::convertible_to<bool>;
  /// Newton's step F'(x)^-1 F(x) at the state last evaluated; false when F' is singular.
  { system.direction(vector) } -> std::convertible_to<bool>;
  /// Called before each iteration with their number so far; false cancels.
  { system.goes_on(0) } -> std::convertible_to<bool>;
};

/// Replaces x by x - step direction for the largest step of 1, 1/2, 1/4, ... down to `min_step` with which
/// the norm falls enough [Armijo's rule; Nocedal and Wright, Numerical Optimization, 2006, section 3.1, with
/// constant 1e-4]. False when there is none: x is then as before, and evaluated again. `norm` is that at x,
/// or a larger one.
template <class System>
bool armijo_step(System& system, Eigen::VectorXd& x, const Eigen::VectorXd& direction, double norm,
                 double min_step) {
  constexpr double sufficient = 1e-4;
  const Eigen::VectorXd base = x;
  for (double step = 1.0; step >= min_step; step *= 0.5) {
    x = base - step * direction;
    if (system.evaluate(x) <= std::sqrt(1.0 - 2.0 * sufficient * step) * norm) return true;
  }
  x = base;
  system.evaluate(x);
  return false;
}

/// How a damped Newton iteration ended.
enum class NewtonEnd { solved, stalled, iteration_limit, singular, cancelled };

struct NewtonRun {
  NewtonEnd end = NewtonEnd::solved;
  int iterations = 0;
};

/// Newton's method with Armijo backtracking on the norm of F, from x, which it improves in place. The norm
/// has to fall below the largest of the last `memory` ones [L. Grippo, F. Lampariello, S. Lucidi, SIAM J.
/// Numer. Anal. 23, 1986, doi:10.1137/0723046].
template <DampedNewtonSystem System>
NewtonRun damped_newton(System& system, Eigen::VectorXd& x, int max_iterations, double min_step,
                        int memory = 1) {
  NewtonRun run;
  Eigen::VectorXd direction;
  std::deque<double> norms;
  for (norms.push_back(system.evaluate(x));; ++run.iterations) {
    if (system.is_solved()) return run;
    run.end = NewtonEnd::cancelled;
    if (!system.goes_on(run.iterations)) return run;
    run.end = NewtonEnd::iteration_limit;
    if (run.iterations >= max_iterations) return run;
    run.end = NewtonEnd::singular;
    if (!system.direction(direction)) return run;
    run.end = NewtonEnd::stalled;
    if (!armijo_step(system, x, direction, *std::ranges::max_element(norms), min_step)) return run;
    run.end = NewtonEnd::solved;
    norms.push_back(system.norm());
    if (static_cast<int>(norms.size()) > memory) norms.pop_front();
  }
}

}  // namespace wavebalance::solvers::detail
