#include "wavebalance/app/analysis/motions.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::app {
namespace {

FoundMotion sampled(solvers::CoexistingMotion found, solvers::ContactProblem& problem, const Scene& scene,
                    const StructureModel& model) {
  const bool struck = !found.motion.impacts.empty();  // harmonics then fall like 1 / n^2
  solvers::ExactStructureOptions how{.tolerance = struck ? 1e-4 : 1e-9};
  if (struck) how.max_harmonics = 2048;
  FoundMotion result;
  result.contacts = contacts_of(found.motion, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (scene.analysis.motion_points > 0)
    result.structure =
        problem.over_periods(found.periods)
            .structure_motion(scene.forcing.frequency, found.motion, scene.analysis.motion_points, how)
            .motion.displacement;
  result.found = std::move(found);
  return result;
}

}  // namespace

Motions coexisting_motions(const Scene& scene, const StructureModel& model,
                           const solvers::Observer& observer) {
  const WallClock clock;
  const bool events = seeks_by_events(scene);
  const bool none = events && model.contact_dynamics() == nullptr;
  if (none) return {.status = "no_modes"};
  solvers::ContactProblem problem =
      events ? exact_problem(scene, model)
             : compose_problem(balance_of(scene, least_start_functions(scene)), model);
  const Analysis& analysis = scene.analysis;
  solvers::MotionsOptions options{.random_starts = analysis.random_starts,
                                  .seed = static_cast<unsigned>(analysis.seed),
                                  .longest = analysis.longest_period,
                                  .observer = observer};
  if (!events) options.tolerance = scene.time.tolerance;
  solvers::CoexistingMotions all = solvers::coexisting_motions(problem, scene.forcing.frequency, options);
  const bool unsettled =
      all.first != solvers::ExactStatus::converged && all.status == solvers::MotionsStatus::not_settled;
  Motions result{.status = std::string(unsettled ? to_string(all.first) : to_string(all.status)),
                 .unsolved = std::move(all.unsolved),
                 .starts = all.starts,
                 .none = all.none,
                 .box = std::move(all.box)};
  for (const auto& [status, count] : all.none_by) result.none_by_status.emplace(to_string(status), count);
  for (solvers::CoexistingMotion& one : all.motions)
    result.motions.push_back(sampled(std::move(one), problem, scene, model));
  result.wall_seconds = clock.seconds();
  return result;
}

}  // namespace wavebalance::app
