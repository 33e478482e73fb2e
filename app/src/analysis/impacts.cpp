#include <algorithm>
#include <chrono>
#include <utility>

#include "analysis/impact_parts.hpp"
#include "analysis/phases_response.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

solvers::ImpactResponseOptions impact_options(const Scene& scene, const Observer& observer) {
  solvers::ImpactResponseOptions options;
  options.observer = observer;
  if (!integrates_in_time(scene.analysis.type)) return options;
  options.solve = false;
  options.near = scene.analysis.tolerance;
  options.max_periods = scene.analysis.max_periods;
  return options;
}

// The motion of the whole structure, whose harmonics fall like 1 / n^2 where impacts bend it.
void copy_structure(solvers::ContactProblem& problem, const Scene& scene, int points, Response& result) {
  constexpr double left_out = 1e-4;
  constexpr int most_harmonics = 2048;
  const solvers::ImpactResponse& found = *result.impacts;
  solvers::ContactProblem longer = problem.over_periods(found.load_periods);
  solvers::StructurePhases whole =
      longer.structure_motion(scene.forcing.frequency, found.motion, points,
                              {.tolerance = left_out, .max_harmonics = most_harmonics});
  result.structure = std::move(whole.motion);
  result.structure_harmonics = whole.harmonics;
  result.structure_left_out = whole.left_out;
}

void solve(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
           Response& result) {
  solvers::ContactProblem problem = impacts_problem(scene, model);
  result.impacts = problem.impacts(scene.forcing.frequency, impact_options(scene, options.observer));
  const solvers::ImpactResponse& found = *result.impacts;
  result.status = to_string(found.motion.status);
  result.converged = result.moves = found.motion.converged();
  result.iterations = integrates_in_time(scene.analysis.type) ? found.integrated : found.motion.iterations;
  result.unknowns = 2 * static_cast<int>(found.motion.impacts.size());
  result.residual = found.motion.residual;
  if (!result.moves) return;
  result.periods = result.motion_periods = found.load_periods;
  result.contacts = contacts_of(found.motion, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (options.structure_points > 0) copy_structure(problem, scene, options.structure_points, result);
  if (options.stability && found.multipliers.size() > 0)
    result.stability = solvers::stability_of_multipliers(found.multipliers);
}

}  // namespace

solvers::ContactProblem impacts_problem(const Scene& scene, const StructureModel& model) {
  Scene paired = scene;
  paired.time = balance_of(scene, least_start_functions(scene)).time;
  return compose_problem(paired, model);
}

solvers::Motion contacts_of(const solvers::ImpactMotion& motion, int points) {
  const Eigen::VectorXd times = time_fractions(points);
  return {motion.displacement(times), motion.velocity(times), motion.force(times)};
}

Response impacts_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Response result;
  result.solved_by = integrates_in_time(scene.analysis.type) ? "" : "impacts";
  result.status = "no_modes";
  result.residual = solvers::missing;
  if (model.contact_dynamics() != nullptr) solve(scene, model, options, result);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace wavebalance::app
