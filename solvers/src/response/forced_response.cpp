#include "wavebalance/solvers/response/forced_response.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "complementarity/josephy_newton.hpp"

namespace wavebalance::solvers {
namespace {

void require_start(const CondensedProblem& problem, const Eigen::VectorXd& guess) {
  if (problem.frequency() == 0.0)
    throw std::invalid_argument(
        "forced_response: the problem has no frequency yet; call set_frequency first");
  if (guess.size() != 0 && guess.size() != problem.samples())
    throw std::invalid_argument("forced_response: guess has " + std::to_string(guess.size()) +
                                " samples; it must be empty or have the problem's " +
                                std::to_string(problem.samples()));
}

// Largest accepted mismatch between force law and displacement, relative to the motion.
constexpr double largest_defect = 1e-9;
// If rounding of u changes the force by more than this (relative), Newton cannot converge and is not tried.
constexpr double largest_rounding = 1e-9;

// A state of the contacts that a method ended with.
struct Candidate {
  NewtonResult newton;
  Eigen::VectorXd displacement;  // samples() values, m
  Eigen::VectorXd force;         // N; empty where it is the law's force at the displacement
  Strategy strategy = Strategy::none;

  bool converged() const { return newton.status == SolveStatus::converged; }
};

Candidate try_newton(ContactSystem& system, Eigen::VectorXd start, Strategy strategy,
                     const ForcedResponseOptions& options) {
  NewtonOptions newton_options = options.newton;
  newton_options.observer = options.observer;
  Candidate candidate;
  candidate.newton = newton(system, start, newton_options);
  candidate.displacement = std::move(start);
  if (candidate.converged()) candidate.strategy = strategy;
  return candidate;
}

// The solution that complementarity found, improved by Newton where displacements resolve the law.
Candidate polish(ContactSystem& system, const LawForce& found, const ForcedResponseOptions& options) {
  Candidate candidate;
  if (found.rounding <= largest_rounding)
    candidate = try_newton(system, found.displacement, found.strategy, options);
  const bool ended = candidate.converged() || candidate.newton.status == SolveStatus::cancelled;
  if (ended || found.defect > largest_defect) return candidate;
  candidate.newton.status = SolveStatus::converged;
  candidate.newton.residual = found.defect;
  candidate.newton.residual_history.push_back(found.defect);
  candidate.newton.condition = found.condition;
  candidate.displacement = found.displacement;
  candidate.force = found.force;
  candidate.strategy = found.strategy;
  return candidate;
}

// The solution by complementarity, or `failed` with what ended it.
Candidate try_complementarity(ContactSystem& system, Candidate failed, const ForcedResponseOptions& options,
                              int& iterations) {
  const LawForce found = josephy_newton(system, options.paths, options.observer);
  iterations += found.pivots;
  if (!found.found) {
    if (found.status != SolveStatus::stalled) failed.newton.status = found.status;
    return failed;
  }
  Candidate candidate = polish(system, found, options);
  iterations += candidate.newton.iterations;
  if (candidate.newton.status == SolveStatus::cancelled) failed.newton.status = SolveStatus::cancelled;
  const bool better = candidate.displacement.size() > 0 && candidate.newton.residual < failed.newton.residual;
  return candidate.converged() || better ? candidate : failed;
}

PeriodicResponse response_of(ContactSystem& system, Candidate candidate, int iterations) {
  PeriodicResponse response;
  response.frequency = system.problem().frequency();
  response.force_by_balance = candidate.force.size() != 0;
  if (!response.force_by_balance) system.evaluate(candidate.displacement);
  response.contact_force = response.force_by_balance ? candidate.force : system.force();
  response.status = candidate.newton.status;
  response.residual = candidate.newton.residual;
  response.residual_history = std::move(candidate.newton.residual_history);
  response.condition = candidate.newton.condition;
  response.iterations = iterations;
  response.strategy = candidate.strategy;
  response.coefficients = system.problem().coefficients(response.contact_force);
  response.displacement = std::move(candidate.displacement);
  return response;
}

}  // namespace

void ForcedResponseOptions::validate() const {
  newton.validate();
  paths.validate();
}

PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess) {
  options.validate();
  require_start(problem, guess);
  ContactSystem system(problem, laws);
  Candidate candidate = try_newton(system, guess.size() != 0 ? guess : problem.contact_free_response(),
                                   Strategy::newton, options);
  int iterations = candidate.newton.iterations;
  const bool cancelled = candidate.newton.status == SolveStatus::cancelled;
  if (!candidate.converged() && !cancelled && options.complementarity)
    candidate = try_complementarity(system, std::move(candidate), options, iterations);
  return response_of(system, std::move(candidate), iterations);
}

}  // namespace wavebalance::solvers
