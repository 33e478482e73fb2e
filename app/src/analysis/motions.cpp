#include "wavebalance/app/analysis/motions.hpp"

#include <chrono>
#include <utility>

#include "analysis/phases_response.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

FoundMotion sampled(solvers::CoexistingMotion found, solvers::ContactProblem& problem, const Scene& scene,
                    const StructureModel& model) {
  constexpr double left_out = 1e-9;
  FoundMotion result;
  const Eigen::VectorXd times = time_fractions(scene.analysis.output_points);
  result.contacts = {found.motion.displacement(times), found.motion.velocity(times),
                     found.motion.force(times)};
  result.contact = leading_contact(result.contacts, model.gaps);
  if (scene.analysis.motion_points > 0)
    result.structure = problem.over_periods(found.periods)
                           .structure_motion(scene.forcing.frequency, found.motion,
                                             scene.analysis.motion_points, {.tolerance = left_out})
                           .motion.displacement;
  result.found = std::move(found);
  return result;
}

}  // namespace

Motions coexisting_motions(const Scene& scene, const StructureModel& model,
                           const solvers::Observer& observer) {
  const auto start = std::chrono::steady_clock::now();
  solvers::ContactProblem problem = compose_problem(balance_of(scene, least_start_functions(scene)), model);
  const Analysis& analysis = scene.analysis;
  solvers::CoexistingMotions all = solvers::coexisting_motions(problem, scene.forcing.frequency,
                                                               {.random_starts = analysis.random_starts,
                                                                .seed = static_cast<unsigned>(analysis.seed),
                                                                .longest = analysis.longest_period,
                                                                .tolerance = scene.time.tolerance,
                                                                .observer = observer});
  Motions result{all.status, {}, all.starts, all.none};
  for (solvers::CoexistingMotion& one : all.motions)
    result.motions.push_back(sampled(std::move(one), problem, scene, model));
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace wavebalance::app
