#include "wavebalance/solvers/response/forced_response.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "complementarity/josephy_newton.hpp"
#include "linalg/option_checks.hpp"

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

/// A motion to start from, samples() values each.
struct Start {
  Eigen::VectorXd displacement;  // m
  Eigen::VectorXd force;         // N; empty where none is known
};

/// What Newton's method ended with in one form.
struct Candidate {
  NewtonResult newton;
  Eigen::VectorXd regularization;  // of its form, see CondensedProblem::set_regularization
  Eigen::VectorXd unknown;         // m, samples() values
  Eigen::VectorXd force;           // N; empty where it is the law's force at the unknown
  Strategy strategy = Strategy::none;
  int iterations = 0;  // of all attempts so far

  bool converged() const { return newton.status == SolveStatus::converged; }
  bool ended() const { return converged() || newton.status == SolveStatus::cancelled; }
};

/// The better of two, with the iterations of both.
Candidate better(Candidate before, Candidate next) {
  next.iterations += before.iterations;
  if (next.newton.status == SolveStatus::cancelled && next.unknown.size() == 0) {
    before.newton.status = SolveStatus::cancelled;
    before.iterations = next.iterations;
    return before;
  }
  if (next.ended() || next.newton.residual < before.newton.residual) return next;
  before.iterations = next.iterations;
  if (next.newton.status == SolveStatus::effort_limit) before.newton.status = next.newton.status;
  return before;
}

/// Leaves the problem in the displacement form, also where an exception is thrown.
class DisplacementFormAtTheEnd {
 public:
  explicit DisplacementFormAtTheEnd(CondensedProblem& problem) : problem_(problem) {}
  ~DisplacementFormAtTheEnd() { problem_.set_regularization({}); }
  DisplacementFormAtTheEnd(const DisplacementFormAtTheEnd&) = delete;
  DisplacementFormAtTheEnd& operator=(const DisplacementFormAtTheEnd&) = delete;

 private:
  CondensedProblem& problem_;
};

/// The problem, its laws and options, as all attempts see them.
struct Task {
  CondensedProblem& problem;
  const ContactLaws& laws;
  const ForcedResponseOptions& options;

  ContactSystem system(const Eigen::VectorXd& regularization) const {
    problem.set_regularization(regularization);
    return ContactSystem(problem, laws);
  }
};

// v = u + f / epsilon in the force form.
Eigen::VectorXd unknown_of(const Start& start, const Eigen::VectorXd& regularization) {
  Eigen::VectorXd unknown = start.displacement;
  const Eigen::Index points = regularization.size() > 0 ? unknown.size() / regularization.size() : 0;
  if (start.force.size() > 0)
    for (Eigen::Index c = 0; c < regularization.size(); ++c)
      unknown.segment(c * points, points) += regularization[c] * start.force.segment(c * points, points);
  return unknown;
}

Candidate improve(const Task& task, ContactSystem& system, Candidate candidate, Strategy strategy) {
  NewtonOptions newton_options = task.options.newton;
  newton_options.observer = task.options.observer;
  if (strategy != Strategy::newton)
    newton_options.max_operations =
        std::min(newton_options.max_operations, task.options.max_fallback_operations);
  candidate.newton = newton(system, candidate.unknown, newton_options);
  candidate.iterations += candidate.newton.iterations;
  if (candidate.converged()) candidate.strategy = strategy;
  return candidate;
}

Candidate try_newton(const Task& task, const Eigen::VectorXd& regularization, const Start& start,
                     Strategy strategy) {
  ContactSystem system = task.system(regularization);
  Candidate candidate;
  candidate.regularization = regularization;
  candidate.unknown = unknown_of(start, regularization);
  return improve(task, system, std::move(candidate), strategy);
}

Candidate try_continuation(const Task& task, const Eigen::VectorXd& regularization, const Start& start) {
  ContactSystem system = task.system(regularization);
  Candidate candidate;
  candidate.regularization = regularization;
  candidate.unknown = unknown_of(start, regularization);
  candidate.newton.residual = std::numeric_limits<double>::infinity();
  ResidualHomotopyOptions homotopy = task.options.continuation;
  homotopy.observer = task.options.observer;
  switch (residual_homotopy(system, candidate.unknown, homotopy)) {
    case HomotopyStatus::arrived:
      return improve(task, system, std::move(candidate), Strategy::continuation);
    case HomotopyStatus::cancelled:
      candidate.newton.status = SolveStatus::cancelled;
      break;
    case HomotopyStatus::effort_limit:
    case HomotopyStatus::lost:
      candidate.newton.status = SolveStatus::stalled;
      break;
  }
  return candidate;
}

/// The solution by the complementarity problem of the contact forces, improved by Newton's method where
/// displacements resolve the law.
Candidate try_complementarity(const Task& task) {
  // Largest accepted mismatch between force law and displacement, relative to the motion.
  constexpr double largest_defect = 1e-9;
  // If rounding of u changes the force by more than this (relative), Newton cannot converge and is not tried.
  constexpr double largest_rounding = 1e-9;
  ContactSystem system = task.system({});
  LawForce found = josephy_newton(system, task.options.paths, task.options.observer);
  Candidate candidate;
  candidate.iterations = found.pivots;
  candidate.newton.residual = std::numeric_limits<double>::infinity();
  candidate.newton.status = found.status;
  if (!found.found) return candidate;
  candidate.newton.status = SolveStatus::stalled;
  candidate.unknown = found.displacement;
  if (found.rounding <= largest_rounding)
    candidate = improve(task, system, std::move(candidate), found.strategy);
  if (candidate.ended() || found.defect > largest_defect) return candidate;
  candidate.newton.status = SolveStatus::converged;
  candidate.newton.residual = found.defect;
  candidate.newton.residual_history.push_back(found.defect);
  candidate.newton.condition = found.condition;
  candidate.unknown = std::move(found.displacement);
  candidate.force = std::move(found.force);
  candidate.strategy = found.strategy;
  return candidate;
}

Candidate solve(const Task& task, const Eigen::VectorXd& guess, int& attractor_periods) {
  const Eigen::VectorXd form = contact_regularization(task.problem, task.laws, task.options.form);
  const Start first{guess.size() != 0 ? guess : task.problem.contact_free_response(), {}};
  Candidate best = try_newton(task, form, first, Strategy::newton);
  if (best.ended() || !task.options.fallbacks) return best;
  if (task.laws.unilateral() && task.laws.have_finite_force() && task.options.form != ContactForm::force)
    best = better(std::move(best), try_complementarity(task));
  if (best.ended()) return best;
  SettlingOptions settling = task.options.settling;
  settling.observer = task.options.observer;
  const SettledMotion motion = settle(task.problem, task.laws, settling);
  attractor_periods = motion.attractor_periods;
  if (motion.cancelled) best.newton.status = SolveStatus::cancelled;
  if (motion.cancelled) return best;
  if (attractor_periods == SettledMotion::not_integrated)
    return better(std::move(best), try_continuation(task, form, first));
  const Start settled{resample(motion.displacement, task.problem.points(), motion.start),
                      resample(motion.force, task.problem.points(), motion.start)};
  best = better(std::move(best), try_newton(task, form, settled, Strategy::settling));
  if (best.ended()) return best;
  // A structure that does not settle to a motion of the load's period may have an unstable one.
  return better(std::move(best), try_continuation(task, form, attractor_periods == 1 ? settled : first));
}

PeriodicResponse response_of(const Task& task, Candidate candidate) {
  ContactSystem system = task.system(candidate.regularization);
  PeriodicResponse response;
  system.evaluate(candidate.unknown);
  response.frequency = task.problem.frequency();
  response.force_by_balance = candidate.force.size() != 0;
  response.contact_force = response.force_by_balance ? std::move(candidate.force) : system.force();
  response.status = candidate.newton.status;
  response.residual = candidate.newton.residual;
  response.residual_history = std::move(candidate.newton.residual_history);
  response.condition = candidate.newton.condition;
  response.iterations = candidate.iterations;
  response.strategy = candidate.strategy;
  response.coefficients = task.problem.coefficients(response.contact_force);
  response.unknown_coefficients = task.problem.unknown_coefficients(response.contact_force);
  response.regularization = std::move(candidate.regularization);
  response.unknown = std::move(candidate.unknown);
  response.displacement = response.regularization.size() == 0
                              ? response.unknown
                              : task.problem.displacement(response.contact_force);
  return response;
}

}  // namespace

void ForcedResponseOptions::validate() const {
  newton.validate();
  paths.validate();
  settling.validate();
  continuation.validate();
  detail::require_positive("ForcedResponseOptions", "max_fallback_operations", max_fallback_operations);
}

PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess) {
  options.validate();
  require_start(problem, guess);
  laws.require(problem.contacts());
  const DisplacementFormAtTheEnd restored(problem);
  const Task task{problem, laws, options};
  int attractor_periods = SettledMotion::not_integrated;
  Candidate candidate = solve(task, guess, attractor_periods);
  PeriodicResponse response = response_of(task, std::move(candidate));
  response.attractor_periods = attractor_periods;
  return response;
}

}  // namespace wavebalance::solvers
