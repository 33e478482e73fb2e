#include "wavebalance/solvers/response/forced_response.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "balance/unknown_in_form.hpp"
#include "linalg/option_checks.hpp"
#include "linalg/safe_norm.hpp"
#include "period/attractor_returns.hpp"
#include "response/free_balance.hpp"
#include "response/springs_at_rest.hpp"
#include "response/stiffness_continuation.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"

namespace wavebalance::solvers {
namespace {

/// A motion to start from, samples() values each.
struct Start {
  Eigen::VectorXd displacement;  // m
  Eigen::VectorXd force;         // N; empty where none is known
};

void require_start(const CondensedProblem& problem, const Start& guess) {
  if (problem.frequency() == 0.0)
    throw std::invalid_argument(
        "forced_response: the problem has no frequency yet; call set_frequency first");
  for (const Eigen::VectorXd* samples : {&guess.displacement, &guess.force})
    if (samples->size() != 0 && samples->size() != problem.samples())
      throw std::invalid_argument("forced_response: guess has " + std::to_string(samples->size()) +
                                  " samples; it must be empty or have the problem's " +
                                  std::to_string(problem.samples()));
}

/// The last iterate of an attempt, in one form, and how it ended.
struct Candidate {
  NewtonResult newton;
  Eigen::VectorXd series_flexibility;  // defines its form, see ContactOperator
  Eigen::VectorXd unknown;             // m, samples() values
  Strategy strategy = Strategy::none;
  int iterations = 0;       // Newton iterations of all attempts so far
  double operations = 0.0;  // and their operations, as ContactSystem counts them

  bool converged() const { return newton.status == SolveStatus::converged; }
  bool ended() const { return converged() || newton.status == SolveStatus::cancelled; }
};

/// The better of two candidates, with the sum of their effort.
Candidate better(Candidate before, Candidate next) {
  next.iterations += before.iterations;
  next.operations += before.operations;
  before.iterations = next.iterations;
  before.operations = next.operations;
  if (next.newton.status == SolveStatus::cancelled && next.unknown.size() == 0) {
    before.newton.status = SolveStatus::cancelled;
    return before;
  }
  if (next.ended() || next.newton.residual < before.newton.residual) return next;
  if (next.newton.status == SolveStatus::effort_limit) before.newton.status = next.newton.status;
  return before;
}

/// The problem, its laws and options, which all attempts have in common.
struct Task {
  CondensedProblem& problem;
  const ContactLaws& laws;
  const ForcedResponseOptions& options;
  double fallback_operations = options.max_fallback_operations;  // of each Newton run after the first

  ContactSystem system(const Eigen::VectorXd& series_flexibility) const {
    return {problem, laws, series_flexibility};
  }
};

/// Whether the attempts so far exclude a further one. No random structure was solved by one after as much.
bool is_spent(const Task& task, const Candidate& best) {
  constexpr double runs = 3.0;  // of Newton's method
  return best.operations > runs * task.fallback_operations;
}

Eigen::VectorXd unknown_of(const Start& start, const Eigen::VectorXd& series_flexibility) {
  return detail::unknown_in_form(start.displacement, start.force, series_flexibility);
}

/// The start of a free structure: near the position in which contact balances its static load. Elsewhere no
/// contact may hold it.
Start balanced_start(const Task& task, bool moving) {
  const Eigen::VectorXd form = contact_series_flexibility(task.problem, task.laws, task.options.form);
  BalancedMotion motion = balanced_motion(task.problem, task.laws, form, moving);
  return {std::move(motion.displacement), std::move(motion.force)};
}

Candidate improve(const Task& task, ContactSystem& system, Candidate candidate, Strategy strategy) {
  NewtonOptions newton_options = task.options.newton;
  newton_options.observer = task.options.observer;
  if (strategy != Strategy::newton)
    newton_options.max_operations = std::min(newton_options.max_operations, task.fallback_operations);
  if (strategy == Strategy::sticking) newton_options.memory = 10;
  const double before = system.operations();
  candidate.newton = newton(system, candidate.unknown, newton_options);
  candidate.operations += system.operations() - before;
  candidate.iterations += candidate.newton.iterations;
  if (candidate.converged()) candidate.strategy = strategy;
  return candidate;
}

Candidate try_newton(const Task& task, const Eigen::VectorXd& series_flexibility, const Start& start,
                     Strategy strategy) {
  ContactSystem system = task.system(series_flexibility);
  Candidate candidate;
  candidate.series_flexibility = series_flexibility;
  candidate.unknown = unknown_of(start, series_flexibility);
  return improve(task, system, std::move(candidate), strategy);
}

Candidate no_solution(SolveStatus status, const Eigen::VectorXd& series_flexibility,
                      Eigen::VectorXd unknown) {
  Candidate candidate;
  candidate.newton.status = status;
  candidate.newton.residual = std::numeric_limits<double>::infinity();
  candidate.series_flexibility = series_flexibility;
  candidate.unknown = std::move(unknown);
  return candidate;
}

/// Follows a residual homotopy from `unknown`.
Candidate try_homotopy(const Task& task, const Eigen::VectorXd& series_flexibility, Eigen::VectorXd unknown,
                       Strategy strategy) {
  ContactSystem system = task.system(series_flexibility);
  Candidate candidate = no_solution(SolveStatus::stalled, series_flexibility, std::move(unknown));
  ResidualHomotopyOptions homotopy = task.options.continuation;
  homotopy.observer = task.options.observer;
  const HomotopyStatus status = residual_homotopy(system, candidate.unknown, homotopy);
  candidate.operations = system.operations();
  if (status == HomotopyStatus::arrived) return improve(task, system, std::move(candidate), strategy);
  if (status == HomotopyStatus::cancelled) candidate.newton.status = SolveStatus::cancelled;
  return candidate;
}

/// Continuation in the stiffness of the contacts, from the linear motion.
Candidate try_stiffness(const Task& task, const Eigen::VectorXd& series_flexibility) {
  ContactSystem system = task.system(series_flexibility);
  Candidate candidate = no_solution(SolveStatus::stalled, series_flexibility, {});
  NewtonOptions newton_options = task.options.newton;
  newton_options.observer = task.options.observer;
  constexpr double runs = 3.0;  // of Newton's method
  newton_options.max_operations = std::min(newton_options.max_operations, runs * task.fallback_operations);
  const detail::StiffnessPath path = detail::follow_stiffness(system, candidate.unknown, newton_options);
  candidate.newton.status = path.status;
  candidate.iterations = path.iterations;
  if (path.status != SolveStatus::converged) return candidate;
  return improve(task, system, std::move(candidate), Strategy::stiffness_continuation);
}

/// Fewer contacts are integrated in time at once, which leads to a stable motion.
bool has_many_with_friction(const Task& task) {
  constexpr int many = 10;
  for (int c = 0; c < task.problem.contacts(); ++c)
    if (task.laws[c].friction()) return task.problem.contacts() > many;
  return false;
}

/// Newton's method from the motion in which all contacts stick, to which a whole step from rest leads. Many
/// contacts that change between sticking and slipping leave no descent, so the residual may rise in between.
Candidate try_sticking(const Task& task, const Eigen::VectorXd& form) {
  ContactSystem system = task.system(form);
  Candidate candidate =
      no_solution(SolveStatus::stalled, form, Eigen::VectorXd::Zero(task.problem.samples()));
  system.evaluate(candidate.unknown);
  Eigen::VectorXd step;
  if (!system.factorize() || !system.solve(system.residual(), step)) return candidate;
  candidate.unknown -= step;
  return improve(task, system, std::move(candidate), Strategy::sticking);
}

/// Continuation in the gaps: the obstacles are lowered onto the linear motion u0. With gaps larger by h
/// no contact closes, and u0 - h solves the balance up to the residual -h. The smallest such h is the start.
Candidate try_gap(const Task& task, const Eigen::VectorXd& series_flexibility) {
  constexpr double above = 1.01;  // a contact that just touches is at a kink, where there is no tangent
  const Eigen::VectorXd& free = task.problem.linear_response();
  const Eigen::VectorXd gaps = task.laws.gaps(task.problem.contacts());
  double height = 0.0;
  for (int c = 0; c < task.problem.contacts(); ++c)
    height =
        std::max(height, free.segment(c * task.problem.points(), task.problem.points()).maxCoeff() - gaps[c]);
  return try_homotopy(task, series_flexibility, free.array() - above * height, Strategy::gap_continuation);
}

/// Continuation in the load, from rest without load. The residual there belongs to the whole load.
Candidate try_load(const Task& task, const Eigen::VectorXd& series_flexibility) {
  return try_homotopy(task, series_flexibility, Eigen::VectorXd::Zero(task.problem.samples()),
                      Strategy::load_continuation);
}

/// The forms in which gaps or load are continued: the form of the options and, if automatic, the force
/// form.
std::vector<Eigen::VectorXd> forms_of(const Task& task) {
  std::vector<Eigen::VectorXd> forms{contact_series_flexibility(task.problem, task.laws, task.options.form)};
  const bool either = task.options.form == ContactForm::automatic && task.laws.have_force_form();
  if (either && forms.front().size() == 0)
    forms.push_back(contact_series_flexibility(task.problem, task.laws, ContactForm::force));
  return forms;
}

Candidate try_residual(const Task& task, const Eigen::VectorXd& series_flexibility, const Start& start) {
  return try_homotopy(task, series_flexibility, unknown_of(start, series_flexibility),
                      Strategy::residual_homotopy);
}

/// The start at a period of a motion in time that begins `start` periods after the first sample.
Start start_of(const Task& task, const Motion& period, double start) {
  const int points = task.problem.points();
  return {resample(period.displacement, points, start), resample(period.force, points, start)};
}

/// Newton's method from the attractor, or from states that nearly recur in it. The result is the better of
/// this one and `best`, the outcome of earlier attempts. Sets `settled`.
Candidate solve_attractor(const Task& task, const Eigen::VectorXd& form, const Start& first, Candidate best,
                          AttractorMotion& settled) {
  AttractorOptions settling = task.options.settling;
  settling.observer = task.options.observer;
  // Returns may be many. Only returns with friction are known to need more for each.
  const bool friction = task.laws.act_over_period();
  Task bounded = task;
  if (!friction) bounded.fallback_operations = task.options.max_fallback_operations;
  double operations = 0.0;
  const auto improve = [&](const Motion& from, double start, Strategy strategy) {
    const bool last = strategy == Strategy::settling;
    const Start there = start_of(task, from, start - task.problem.pair().first_sample());
    Candidate next = try_newton(last ? task : bounded, form, there, strategy);
    operations += next.operations;
    best = better(std::move(best), std::move(next));
    return best.ended() || (!friction && operations > bounded.fallback_operations);
  };
  settled = settle(task.problem, task.laws, settling, [&](const Motion& piece, double start) {
    return improve(piece, start, Strategy::recurrence);
  });
  const AttractorMotion& motion = settled;
  if (motion.cancelled) best.newton.status = SolveStatus::cancelled;
  if (best.ended()) return best;
  if (!motion.integrated() || !motion.returns.empty())
    return is_spent(task, best) ? best : better(std::move(best), try_residual(task, form, first));
  improve(motion.last, motion.start, Strategy::settling);
  if (best.ended() || is_spent(task, best)) return best;
  const Start last = start_of(task, motion.last, motion.start - task.problem.pair().first_sample());
  return better(std::move(best), try_residual(task, form, last));
}

/// The motion at rest under the static load.
Candidate rest_of(const Task& task, const Eigen::VectorXd& form) {
  const double whole = task.problem.load_scale();
  task.problem.set_load_scale(0.0);
  const Start start{task.problem.linear_response(), {}};
  Candidate rest = try_newton(task, form, start, Strategy::load_continuation);
  if (rest.converged()) {
    ContactSystem system = task.system(form);
    rest.unknown = response_at(system, std::move(rest.unknown)).displacement;
  }
  task.problem.set_load_scale(whole);
  return rest;
}

/// With the contacts that are closed at rest as springs of the structure. They may stay closed where the
/// motion without contact would open all of them, as springs and dimples that press against each other. Sets
/// `settled` if it is not known. An aperiodic motion is not integrated once more.
Candidate solve_from_rest(const Task& task, const Eigen::VectorXd& form, AttractorMotion& settled) {
  const Candidate rest = rest_of(task, form);
  if (!rest.converged()) return no_solution(rest.newton.status, form, {});
  auto moved = detail::springs_at_rest(task.problem, task.laws, rest.unknown);
  if (!moved) return no_solution(SolveStatus::stalled, form, {});
  const Task beside{moved->problem, moved->laws, task.options, task.fallback_operations};
  const Start linear{moved->problem.linear_response(), {}};
  Candidate found = try_newton(beside, {}, linear, Strategy::load_continuation);
  if (!found.ended())
    found = better(std::move(found), try_homotopy(beside, {}, rest.unknown, Strategy::load_continuation));
  AttractorMotion attractor;
  const bool aperiodic = settled.attractor_periods == 0;
  if (!found.ended() && !aperiodic) found = solve_attractor(beside, {}, linear, std::move(found), attractor);
  if (settled.attractor_periods == AttractorMotion::unknown && attractor.integrated()) {
    settled = std::move(attractor);
    settled.last.force = task.laws.force(settled.last.displacement);
  }
  if (!found.converged()) return no_solution(found.newton.status, form, {});
  ContactSystem system = task.system({});
  system.evaluate(found.unknown);
  return try_newton(task, form, {found.unknown, system.force()}, found.strategy);
}

/// With the cost of some iterations if that is more: one with a hundred contacts needs half of the usual
/// limit.
Task with_room_for_iterations(Task task, const Candidate& first) {
  constexpr double iterations = 20.0;
  task.fallback_operations =
      std::max(task.fallback_operations, iterations * first.operations / std::max(1, first.iterations));
  return task;
}

Candidate solve(const Task& at_first, const Start& first, bool guessed, AttractorMotion& settled) {
  const Eigen::VectorXd form =
      contact_series_flexibility(at_first.problem, at_first.laws, at_first.options.form);
  Candidate best = try_newton(at_first, form, first, Strategy::newton);
  if (best.ended() || !at_first.options.fallbacks) return best;
  const Task task = with_room_for_iterations(at_first, best);
  if (guessed && task.options.stay_near_guess)
    return better(std::move(best), try_residual(task, form, first));
  // Fewer contacts are lowered onto the motion, which leads to the solution that is connected with it.
  constexpr int many_contacts = 50;
  if (form.size() == 0 && !task.problem.is_free() && task.problem.contacts() > many_contacts) {
    best = better(std::move(best), try_stiffness(task, form));
    if (best.ended()) return best;
  }
  // A continuation in the load passes through sticking and slipping sample by sample.
  if (task.laws.act_over_period()) {
    if (has_many_with_friction(task)) best = better(std::move(best), try_sticking(task, form));
    if (best.ended()) return best;
    return solve_attractor(task, form, first, std::move(best), settled);
  }
  for (const Eigen::VectorXd& tried : forms_of(task)) {
    best = better(std::move(best), task.laws.unilateral() ? try_gap(task, tried) : try_load(task, tried));
    if (best.ended()) return best;
  }
  best = solve_attractor(task, form, first, std::move(best), settled);
  if (best.ended() || is_spent(task, best) || !task.laws.unilateral() || task.problem.is_free()) return best;
  return better(std::move(best), solve_from_rest(task, form, settled));
}

/// PeriodicResponse::rounding_error. `system` was evaluated at the response.
double rounding_error_of(CondensedProblem& problem, ContactSystem& system, const PeriodicResponse& response) {
  constexpr double negligible = 1e-6;
  const double at_these_forces = problem.rounding_error(response.force_on_held_structure);
  if (!response.converged() || !(at_these_forces > negligible) || !system.factorize()) return at_these_forces;
  Eigen::VectorXd change;
  if (!system.solve(problem.rounding_motion(response.force_on_held_structure), change))
    return at_these_forces;
  return relative_to(safe_norm(response.unknown), safe_norm(change));
}

PeriodicResponse response_of(const Task& task, Candidate candidate) {
  ContactSystem system = task.system(candidate.series_flexibility);
  PeriodicResponse response = response_at(system, std::move(candidate.unknown));
  response.status = candidate.newton.status;
  response.residual = candidate.newton.residual;
  response.residual_history = std::move(candidate.newton.residual_history);
  response.condition = candidate.newton.condition;
  response.iterations = candidate.iterations;
  response.strategy = candidate.strategy;
  response.rounding_error = rounding_error_of(task.problem, system, response);
  return response;
}

}  // namespace

void ForcedResponseOptions::validate() const {
  newton.validate();
  settling.validate();
  continuation.validate();
  detail::require_positive("ForcedResponseOptions", "max_fallback_operations", max_fallback_operations);
}

PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& any_laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess,
                                 const Eigen::VectorXd& guess_force) {
  options.validate();
  Start start{guess, guess_force};
  require_start(problem, start);
  const bool guessed = guess.size() > 0;
  if (!guessed) start = {problem.linear_response(), {}};
  const ContactLaws laws = any_laws.at(problem.load_frequency());
  laws.require(problem.contacts());
  const Task task{problem, laws, options};
  AttractorMotion settled;
  Candidate candidate;
  if (problem.is_free() && !static_load_is_balanced(problem, laws)) {
    candidate = no_solution(SolveStatus::unbalanced, contact_series_flexibility(problem, laws, options.form),
                            problem.linear_response());
  } else {
    const bool places = problem.is_free() && guess.size() == 0;
    // A static load may keep contacts closed. The structure then moves much less than without contact.
    const bool pressed = places && problem.balancing_force().norm() > 1e-9 * problem.spring_force();
    if (places) start = balanced_start(task, !pressed);
    candidate = solve(task, start, guessed, settled);
    if (places && !candidate.ended())
      candidate = better(std::move(candidate), solve(task, balanced_start(task, pressed), guessed, settled));
  }
  PeriodicResponse response = response_of(task, std::move(candidate));
  response.attractor_periods = settled.attractor_periods;
  if (settled.integrated()) response.settled = std::make_shared<const AttractorMotion>(std::move(settled));
  if (!response.converged() && response.status != SolveStatus::cancelled)
    for (const Eigen::VectorXd& at : {problem.linear_response(), response.displacement})
      laws.require_numbers(problem.contacts(), at);
  return response;
}

}  // namespace wavebalance::solvers
