#include "wavebalance/solvers/problem/motion_stability.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "linalg/multipliers.hpp"
#include "stability/floquet_determinant.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace wavebalance::solvers {
namespace {

MotionStability stability_of(const UnstableMultipliers& count) {
  MotionStability result;
  result.status = count.status != StabilityStatus::converged ? to_string(count.status)
                  : count.count > 0                          ? "unstable"
                                                             : "stable";
  result.unstable = count.count;
  result.leading = count.leading;
  return result;
}

// All multipliers at once, or for many states only their count.
MotionStability is_exact(const ExactSolution& motion, const ContactDynamics& dynamics, double frequency) {
  const Eigen::VectorXcd all = motion.multipliers();
  MotionStability result;
  if (all.size() > 0) {
    result = stability_of_multipliers(all);
  } else {
    UnstableMultipliers count;
    count.count = motion.count_unstable();
    if (count.count < 0) count.status = StabilityStatus::effort_limit;
    result = stability_of(count);
  }
  if (result.unstable < 0 && has_undamped_pole(dynamics, 2.0 * std::numbers::pi * frequency))
    result.status = to_string(StabilityStatus::undamped);
  result.is_exact = true;
  return result;
}

MotionStability by_balance(const CondensedProblem& problem, const ContactLaws& laws,
                           const PeriodicResponse& response, const ContactDynamics& dynamics) {
  FloquetOptions options;
  options.stability = stability_options(problem);
  options.max_operations = options.stability.max_operations;
  const auto count = unstable_multipliers(dynamics, problem, laws, response, options.stability);
  MotionStability result = stability_of(count);
  const bool exact = std::isfinite(count.leading.real()) && count.leading_error == 0.0;
  if (count.status != StabilityStatus::converged || exact) return result;
  const FloquetExponents exponents = floquet_exponents(dynamics, problem, laws, response, options);
  result.leading_error = count.leading_error;
  if (exponents.status != StabilityStatus::converged || exponents.values.empty()) return result;
  result.leading = exponents.values.front().multiplier;
  result.leading_error = 0.0;
  return result;
}

}  // namespace

StabilityOptions stability_options(const CondensedProblem& problem) {
  constexpr int most_harmonics = 255;
  StabilityOptions options;
  options.harmonics = std::clamp((problem.pair().functions() - 1) / 2, 1, most_harmonics);
  options.max_operations = 3e10;
  return options;
}

namespace {

// The largest, Im >= 0. Uniform damping gives all multipliers one modulus, among which rounding would choose:
// it is then the one nearest to the positive real axis.
std::complex<double> leading_of(const Eigen::VectorXcd& multipliers) {
  constexpr double same = 1.0 - 1e-9;
  std::complex<double> leading = multipliers[0];
  for (const std::complex<double> multiplier : multipliers)
    if (std::abs(multiplier) > same * std::abs(multipliers[0]) && multiplier.real() > leading.real())
      leading = multiplier;
  return {leading.real(), std::abs(leading.imag())};
}

}  // namespace

MotionStability stability_of_multipliers(const Eigen::VectorXcd& multipliers) {
  UnstableMultipliers count;
  count.count = detail::count_outside(multipliers);
  if (count.count < 0) count.status = StabilityStatus::on_unit_circle;
  MotionStability result = stability_of(count);
  if (multipliers.size() > 0) result.leading = leading_of(multipliers);
  return result;
}

MotionStability motion_stability(const CondensedProblem& problem, const ContactLaws& laws,
                                 const PeriodicResponse& response, const ContactDynamics& dynamics,
                                 const ExactSolution* motion) {
  const auto start = std::chrono::steady_clock::now();
  const bool sought = motion && (motion->status == ExactStatus::not_found ||
                                 motion->status == ExactStatus::too_many_intervals);
  if (sought) {
    MotionStability unknown;
    const bool undamped = !laws.depend_on_velocity() && !laws.act_over_period() &&  // which may damp
                          has_undamped_pole(dynamics, 2.0 * std::numbers::pi * problem.frequency());
    unknown.status = undamped ? to_string(StabilityStatus::undamped) : to_string(motion->status);
    return unknown;
  }
  MotionStability result = motion && motion->converged() ? is_exact(*motion, dynamics, response.frequency)
                                                         : by_balance(problem, laws, response, dynamics);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace wavebalance::solvers
