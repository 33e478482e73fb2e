#include "attractors/limit_cycle.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::app {
namespace {

solvers::LimitCycleOptions options_of(const Scene& scene, const StartMotion& start,
                                      const Observer& observer) {
  solvers::LimitCycleOptions options{
      .near = {start.contacts.displacement, start.contacts.force, start.frequency},
      .random_starts = scene.analysis.random_starts,
      .seed = static_cast<unsigned>(scene.analysis.seed),
      .max_periods = scene.analysis.max_periods};
  options.motion.tolerance = scene.time.tolerance > 0.0 ? scene.time.tolerance : default_exact_tolerance;
  options.motion.observer = observer;
  return options;
}

// Data of a motion, which may be unsolved.
void copy_solution(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                   LimitCycleResponse& result) {
  Response& response = result.response;
  const solvers::ExactSolution motion = std::exchange(result.found.motion, {});
  response.exact = {motion, solvers::missing, solvers::missing};
  response.iterations = motion.iterations;
  response.unknowns = motion.unknowns;
  response.moves = motion.parts != nullptr;
  if (!response.moves) return;
  response.residual = motion.residual;
  result.frequency = motion.frequency();
  Scene moving = scene;
  moving.forcing.frequency = result.frequency;
  solvers::ContactProblem problem = exact_problem(moving, model);
  copy_motion(problem, motion, moving, model, options, response);
}

}  // namespace

LimitCycleResponse limit_cycle_response(const Scene& scene, const StructureModel& model,
                                        const StartMotion& start, const ResponseOptions& options) {
  constexpr double any = 0.618034;  // Hz, of the static loads
  const WallClock clock;
  LimitCycleResponse result;
  Response& response = result.response;
  response.solved_by = name_of(TimeMethod::exact);
  response.strategy = "from_settling";
  response.residual = solvers::missing;
  response.status = "no_modes";
  if (model.contact_dynamics() == nullptr) return result;
  solvers::ContactProblem problem = exact_problem(scene, model);
  result.found = solvers::limit_cycle(problem.exact_problem(any), options_of(scene, start, options.observer));
  response.converged = result.found.status == solvers::LimitCycleStatus::converged;
  response.status = to_string(result.found.status);
  copy_solution(scene, model, options, result);
  response.wall_seconds = clock.seconds();
  return result;
}

}  // namespace wavebalance::app
