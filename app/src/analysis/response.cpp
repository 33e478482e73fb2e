#include "wavebalance/app/analysis/response.hpp"

#include <fmt/format.h>

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "wavebalance/solvers/problem/exact_along.hpp"
#include "wavebalance/solvers/response/complementarity.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"

namespace wavebalance::app {
namespace {

constexpr int most_panels_cut = 60;  // beyond, they have unknowns for less than these operations

/// The motion of the structure near the response, and how long that took. One farther away is another motion.
void note_exact(solvers::ContactProblem& problem, const solvers::PeriodicResponse& found,
                const ResponseOptions& options, Response& result) {
  const WallClock clock;
  solvers::CollocationOptions exact;
  exact.max_operations = most_operations_of_exact(problem.contacts());
  exact.max_cut_panels = most_panels_cut;
  exact.observer = options.observer;
  result.exact = solvers::exact_near(problem, found, {.exact = exact});
  result.exact_seconds = clock.seconds();
}

/// Sets the contacts' motion, the contact with the largest force, and the motion of the whole structure if
/// the options require it.
void note_motion(solvers::ContactProblem& problem, const solvers::PeriodicResponse& found, const Scene& scene,
                 const StructureModel& model, const ResponseOptions& options, Response& result) {
  result.contacts = problem.motion(found, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (options.structure_points > 0)
    result.structure = problem.structure_motion(found, options.structure_points);
  if (!found.converged()) return;
  if (options.exact) note_exact(problem, found, options, result);
  if (options.stability)
    result.stability = problem.stability(found, result.exact ? &result.exact->motion : nullptr);
  if (found.settled) result.settled = from_rest(*found.settled);
  note_attractor(problem, scene, options.observer, result);
}

/// The exact motion that time integration converges to, or an unstable one near its returns; nothing where
/// none is found.
std::optional<solvers::ExactSolution> exact_from(solvers::ContactProblem& problem, double frequency,
                                                 const solvers::AttractorMotion& settled,
                                                 solvers::CollocationOptions options) {
  if (settled.repeats_after(solvers::load_periods(problem.condensed())))
    return problem.exact_near(frequency, settled, options);
  constexpr double share = 0.6;  // the balance from each return has taken seconds before
  options.max_operations *= share;
  for (const solvers::Motion& piece : settled.returns) {
    auto motion = problem.exact_near(frequency, settled.at(piece), options);
    if (!motion || motion->converged()) return motion;
    options.max_operations -= motion->operations;
    if (motion->status != solvers::ExactStatus::not_found || options.max_operations <= 0.0) break;
  }
  return std::nullopt;
}

/// Whether an exact motion is known now, instead of a balance.
bool solve_exactly(solvers::ContactProblem& problem, const solvers::PeriodicResponse& found,
                   const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                   Response& result) {
  if (!options.exact_instead || found.converged() || found.settled == nullptr) return false;
  // Friction that never repeats has wear and work, which the record of the motion that occurs has.
  if (has_friction(scene) && found.settled->attractor_periods == 0) return false;
  solvers::CollocationOptions exact;
  exact.max_operations = most_operations_of_exact(problem.contacts());
  exact.observer = options.observer;
  const auto motion = exact_from(problem, scene.forcing.frequency, *found.settled, exact);
  if (!motion || !motion->converged()) return false;
  const int load_periods = solvers::load_periods(problem.condensed());
  const bool repeats = found.settled->repeats_after(load_periods);
  result = {};
  result.solved_by = result.form = name_of(TimeMethod::exact);
  result.status = to_string(motion->status);
  result.strategy = repeats ? "from_settling" : to_string(solvers::Strategy::recurrence);
  result.attractor_periods = found.attractor_periods;
  result.settled = from_rest(*found.settled);
  copy_exact(problem, *motion, load_periods, scene, model, options, result);
  return true;
}

void solve_law(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
               Response& result) {
  solvers::ForcedResponseOptions solver;
  solver.observer = options.observer;
  solver.form = scene.contact.form;
  solver.stay_near_guess = options.stay_near_guess;
  solvers::ContactProblem problem = compose_problem(scene, model);
  const auto found = problem.respond(scene.forcing.frequency, solver, {options.guess, options.guess_force});
  if (solve_exactly(problem, found, scene, model, options, result)) return;
  copy_solution(result, problem.condensed(), found, scene, model);
  result.start_distance = relative_distance(found.displacement, options.guess);
  note_motion(problem, found, scene, model, options, result);
}

/// A scene without a pair uses Fourier functions, mostly the cheapest choice for an error.
Scene with_pair(Scene scene) {
  if (scene.time.trial.empty()) scene.time.trial = scene.time.weight = "fourier";
  return scene;
}

solvers::RefinementOptions refinement_options(const Scene& scene, const ResponseOptions& options) {
  solvers::RefinementOptions refinement;
  refinement.tolerance = scene.time.tolerance;
  const bool wavelets = is_wavelet(scene.time.trial) || is_wavelet(scene.time.weight);
  if (wavelets) refinement.first_functions = 16;
  if (wavelets) refinement.first_points = 32;
  refinement.solver.form = scene.contact.form;
  refinement.observer = options.observer;
  return refinement;
}

void solve_refined(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                   Response& result) {
  const solvers::ContactLaws laws = make_laws(scene);
  auto found = solve_to_tolerance(scene, model, laws, options, result);
  solvers::ContactProblem problem(std::move(*found.problem), laws, model.dynamics);
  note_motion(problem, found.response, scene, model, options, result);
}

/// A converged response without accurate digits is none.
void require_digits(Response& result) {
  if (!(result.rounding_error > largest_rounding_error)) return;
  const bool inaccurate = result.converged || result.status == to_string(solvers::SolveStatus::inaccurate);
  result.converged = result.moves = false;
  if (inaccurate) result.status = inaccurate_status(result.rounding_error);
}

}  // namespace

double most_operations_of_exact(int contacts) {
  constexpr double of_few = 4e10, few_contacts = 16.0, most = 2.0;
  return of_few * std::clamp(contacts / few_contacts, 1.0, most);
}

solvers::RefinementResult solve_to_tolerance(const Scene& scene, const StructureModel& model,
                                             const solvers::ContactLaws& laws, const ResponseOptions& options,
                                             Response& result) {
  const Scene chosen = with_pair(scene);
  const auto make = [&](int functions, int points) {
    Scene sized = chosen;
    sized.time.functions = functions;
    sized.time.quadrature_points = points;
    return make_problem(sized, model);
  };
  auto found = solvers::response_to_tolerance(make, laws, refinement_options(chosen, options));
  copy_solution(result, *found.problem, found.response, scene, model);
  result.converged = found.converged();
  result.status = to_string(found.status);
  result.iterations = 0;
  result.unknowns = model.contacts() * found.levels.back().functions;
  for (const auto& level : found.levels) result.iterations += level.iterations;
  result.refinement =
      Refinement{chosen.time.trial, chosen.time.weight, found.estimated_error, found.seconds, found.levels};
  return found;
}

void copy_solution(Response& result, solvers::CondensedProblem& problem,
                   const solvers::PeriodicResponse& found, const Scene& scene, const StructureModel& model) {
  result.converged = result.moves = found.converged();
  result.status = to_string(found.status);
  result.residual = found.residual;
  result.iterations = found.iterations;
  result.strategy = to_string(found.strategy);
  result.attractor_periods = found.attractor_periods;
  result.periods = solvers::load_periods(problem);
  result.motion_periods = solvers::motion_periods(problem, found);
  if (result.periods > 1) result.change_after_one = solvers::change_after(problem, found, 1);
  const bool force_form = found.series_flexibility.size() > 0;
  result.form = to_string(force_form ? solvers::ContactForm::force : solvers::ContactForm::displacement);
  if (force_form) {
    result.unknown_coefficients = found.unknown_coefficients;
    result.series_flexibility = found.series_flexibility;
  }
  result.condition = std::max(problem.condition(), found.condition);
  result.rounding_error = found.rounding_error;
  if (!is_rigid(scene.contact.law)) return;
  const auto held = solvers::complementarity(found.displacement, found.contact_force, model.gaps);
  result.rigid = {held.max_penetration, held.min_force, held.product};
}

void note_structure(Response& result, solvers::ExactStructureMotion whole) {
  result.structure = std::move(whole.motion);
  result.structure_harmonics = whole.harmonics;
  result.structure_left_out = whole.left_out;
}

double relative_distance(const Eigen::VectorXd& found, const Eigen::VectorXd& start) {
  if (start.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  return (found - start).norm() / start.norm();
}

std::string inaccurate_status(double rounding_error) {
  return fmt::format(
      "inaccurate: poor conditioning, with rounding errors of about {:.0e} of the motion, more than {:.0e}",
      rounding_error, largest_rounding_error);
}

Time solved_time(Time time, const Response& response) {
  if (!response.refinement) return time;
  const auto& last = response.refinement->levels.back();
  time.trial = response.refinement->trial;
  time.weight = response.refinement->weight;
  time.functions = last.functions;
  time.quadrature_points = last.points;
  return time;
}

Response weighted_residual_response(const Scene& scene, const ResponseOptions& options) {
  return weighted_residual_response(scene, make_model(scene, options.observer), options);
}

Response weighted_residual_response(const Scene& scene, const StructureModel& model,
                                    const ResponseOptions& options) {
  if (auto exact = exact_to_tolerance(scene, model, options)) return *std::move(exact);
  const WallClock clock;
  Response result;
  result.solved_by = name_of(TimeMethod::balance);
  result.unknowns = model.contacts() * scene.time.functions;
  try {
    if (scene.time.tolerance > 0.0)
      solve_refined(scene, model, options, result);
    else
      solve_law(scene, model, options, result);
  } catch (const solvers::SingularSystem& error) {
    result.converged = result.moves = false;  // also when only the whole structure's field cannot be had
    result.status = std::string("singular: ") + error.what();
    result.residual = std::numeric_limits<double>::quiet_NaN();
    result.condition = std::numeric_limits<double>::infinity();
  }
  require_digits(result);
  result.wall_seconds =
      clock.seconds() - result.exact_seconds - (result.stability ? result.stability->wall_seconds : 0.0);
  return result;
}

AttractorFromRest from_rest(const solvers::AttractorMotion& settled) {
  if (!settled.integrated()) return {settled.attractor_periods};
  return {settled.attractor_periods, settled.last.displacement.maxCoeff(), settled.last.force.maxCoeff()};
}

void note_attractor(solvers::ContactProblem& problem, const Scene& scene, const Observer& observer,
                    Response& result) {
  const bool unstable = result.stability && result.stability->unstable > 0;
  if (!unstable || scene.analysis.subharmonic > 1)
    result.settled.reset();
  else if (!result.settled)
    result.settled = from_rest(problem.settle(scene.forcing.frequency, {.observer = observer}));
}

}  // namespace wavebalance::app
