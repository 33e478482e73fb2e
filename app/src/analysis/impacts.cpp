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

// The motion of the whole structure, whose harmonics fall like 1 / n^2 where impacts bend it.
void copy_structure(solvers::ContactProblem& problem, const Scene& scene, int points, Response& result) {
  constexpr double left_out = 1e-4;
  constexpr int most_harmonics = 2048;
  const solvers::ImpactResponse& found = *result.impacts;
  solvers::ContactProblem longer = problem.over_periods(found.load_periods);
  const solvers::StructurePhasesOptions how{.tolerance = left_out, .max_harmonics = most_harmonics};
  const double frequency = scene.forcing.frequency;
  solvers::StructurePhases whole = found.lasts()
                                       ? longer.structure_motion(frequency, found.lasting, points, how)
                                       : longer.structure_motion(frequency, found.motion, points, how);
  result.structure = std::move(whole.motion);
  result.structure_harmonics = whole.harmonics;
  result.structure_left_out = whole.left_out;
}

void solve(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
           Response& result) {
  solvers::ContactProblem problem = impacts_problem(scene, model);
  result.impacts = problem.impacts(scene.forcing.frequency, {.observer = options.observer});
  const solvers::ImpactResponse& found = *result.impacts;
  const solvers::PhaseMotion& lasting = found.lasting;
  result.status = found.lasts() ? to_string(lasting.status) : to_string(found.motion.status);
  result.converged = found.converged();
  result.moves = found.lasts() || result.converged;
  result.iterations = found.lasts() ? lasting.iterations : found.motion.iterations;
  result.unknowns = found.lasts() ? lasting.unknowns : 2 * static_cast<int>(found.motion.impacts.size());
  result.residual = found.lasts() ? lasting.residual : found.motion.residual;
  if (!result.moves) return;
  if (found.lasts()) result.solved_by = name_of(TimeMethod::phases);
  if (found.lasts()) result.phases = {lasting, solvers::missing, solvers::missing};
  result.struck = found.impacts();
  result.periods = result.motion_periods = found.load_periods;
  result.contacts = found.lasts() ? contacts_of(lasting, scene.analysis.output_points)
                                  : contacts_of(found.motion, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (options.structure_points > 0) copy_structure(problem, scene, options.structure_points, result);
  if (options.stability && found.multipliers.size() > 0)
    result.stability = solvers::stability_of_multipliers(found.multipliers);
  if (result.stability) result.stability->by_phases = found.lasts();
}

}  // namespace

solvers::ContactProblem impacts_problem(const Scene& scene, const StructureModel& model) {
  Scene paired = scene;
  paired.time = balance_of(scene, least_start_functions(scene)).time;
  return compose_problem(paired, model);
}

solvers::ContactProblem exact_problem(const Scene& scene, const StructureModel& model) {
  return scene.time.trial.empty() ? impacts_problem(scene, model) : compose_problem(scene, model);
}

solvers::Motion contacts_of(const solvers::ImpactMotion& motion, int points) {
  const Eigen::VectorXd times = time_fractions(points);
  const Eigen::MatrixXd u = motion.displacement(times);
  return {u, motion.velocity(times), Eigen::MatrixXd::Zero(u.rows(), u.cols())};
}

solvers::Motion contacts_of(const solvers::PhaseMotion& motion, int points) {
  const Eigen::VectorXd times = time_fractions(points);
  return {motion.displacement(times), motion.velocity(times), motion.force(times)};
}

Response impacts_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Response result;
  result.solved_by = "impacts";
  result.status = "no_modes";
  result.residual = solvers::missing;
  if (model.contact_dynamics() != nullptr) solve(scene, model, options, result);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace wavebalance::app
