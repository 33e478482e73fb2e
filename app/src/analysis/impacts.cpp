
#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::app {
namespace {

// The motion of the whole structure, whose harmonics fall like 1 / n^2 where impacts bend it.
void copy_structure(solvers::ContactProblem& problem, const Scene& scene, int points, Response& result) {
  constexpr double left_out = 1e-4;
  constexpr int most_harmonics = 2048;
  note_structure(result, problem.over_periods(result.periods)
                             .structure_motion(scene.forcing.frequency, result.impacts->motion, points,
                                               {.tolerance = left_out, .max_harmonics = most_harmonics}));
}

void solve(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
           Response& result) {
  solvers::ContactProblem problem = exact_problem(scene, model);
  result.impacts = problem.impacts(scene.forcing.frequency, {.observer = options.observer});
  const solvers::ImpactResponse& found = *result.impacts;
  const solvers::ExactSolution& motion = found.motion;
  result.status = to_string(motion.status);
  result.converged = motion.converged();
  result.moves = found.moves();
  result.iterations = motion.iterations;
  result.unknowns = motion.unknowns;
  if (!result.moves) return;
  result.residual = motion.residual;
  if (found.lasts()) result.solved_by = name_of(TimeMethod::exact);
  if (found.lasts()) result.exact = {motion, solvers::missing, solvers::missing};
  result.struck = motion.impacts;
  result.periods = result.motion_periods = found.load_periods;
  result.contacts = contacts_of(motion, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (options.structure_points > 0) copy_structure(problem, scene, options.structure_points, result);
  if (options.stability && found.multipliers.size() > 0)
    result.stability = solvers::stability_of_multipliers(found.multipliers);
  if (result.stability) result.stability->is_exact = found.lasts();
}

}  // namespace

solvers::ContactProblem exact_problem(const Scene& scene, const StructureModel& model) {
  if (!scene.time.trial.empty() && !solves_by_impacts(scene)) return compose_problem(scene, model);
  Scene paired = scene;
  paired.time = balance_of(scene, least_start_functions(scene)).time;
  return compose_problem(paired, model);
}

solvers::Motion contacts_of(const solvers::ExactSolution& motion, int points) {
  const Eigen::VectorXd times = time_fractions(points);
  return {motion.displacement(times), motion.velocity(times), motion.force(times)};
}

Response impacts_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  const WallClock clock;
  Response result;
  result.solved_by = "impacts";
  result.status = "no_modes";
  result.residual = solvers::missing;
  if (model.contact_dynamics() != nullptr) solve(scene, model, options, result);
  result.wall_seconds = clock.seconds();
  return result;
}

}  // namespace wavebalance::app
