#include "wavebalance/app/analysis/motions.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "analysis/exact_parts.hpp"
#include "analysis/phases_response.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

FoundMotion sampled(solvers::CoexistingMotion found, solvers::ContactProblem& problem, const Scene& scene,
                    const StructureModel& model) {
  constexpr double left_out = 1e-9;
  FoundMotion result;
  result.contacts = contacts_of(found.motion, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (scene.analysis.motion_points > 0)
    result.structure = problem.over_periods(found.periods)
                           .structure_motion(scene.forcing.frequency, found.motion,
                                             scene.analysis.motion_points, {.tolerance = left_out})
                           .motion.displacement;
  result.iterations = found.motion.iterations;
  result.unknowns = found.motion.unknowns;
  result.residual = found.motion.residual;
  result.found = std::move(found);
  return result;
}

solvers::MotionSource source_of(const solvers::CoexistingImpacts& one) {
  if (!one.settled) return solvers::MotionSource::newton;
  return one.from_random ? solvers::MotionSource::random : solvers::MotionSource::rest;
}

FoundMotion sampled(solvers::CoexistingImpacts one, int starts, solvers::ContactProblem& problem,
                    const Scene& scene, const StructureModel& model) {
  constexpr double left_out = 1e-4;
  constexpr int most_harmonics = 2048;
  FoundMotion result;
  solvers::ImpactResponse& response = one.response;
  const solvers::PhaseMotion& motion = response.motion;
  result.contacts = contacts_of(motion, scene.analysis.output_points);
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (scene.analysis.motion_points > 0)
    result.structure = problem.over_periods(response.load_periods)
                           .structure_motion(scene.forcing.frequency, motion, scene.analysis.motion_points,
                                             {.tolerance = left_out, .max_harmonics = most_harmonics})
                           .motion.displacement;
  result.iterations = motion.iterations;
  result.unknowns = motion.unknowns;
  result.residual = motion.residual;
  result.found.periods = response.load_periods;
  result.found.stability = solvers::stability_of_multipliers(response.multipliers);
  result.found.found_by = source_of(one);
  result.found.arrivals = one.arrivals;
  if (starts > 0) {
    const double share = double(one.arrivals) / starts;
    result.found.share = share;
    result.found.share_error = std::sqrt(share * (1.0 - share) / starts);
  }
  result.impacts = std::move(response);
  return result;
}

Motions impact_motions(const Scene& scene, const StructureModel& model, const solvers::Observer& observer) {
  Motions result;
  result.status = "no_modes";
  if (model.contact_dynamics() == nullptr) return result;
  solvers::ContactProblem problem = exact_problem(scene, model);
  const Analysis& analysis = scene.analysis;
  solvers::ImpactMotions all =
      problem.coexisting_impacts(scene.forcing.frequency, {.random_starts = analysis.random_starts,
                                                           .seed = static_cast<unsigned>(analysis.seed),
                                                           .longest = analysis.longest_period,
                                                           .observer = observer});
  result.status = to_string(all.status);
  result.starts = all.starts;
  for (const auto& [status, count] : all.none) {
    result.none += count;
    result.none_by_status.emplace(to_string(status), count);
  }
  for (solvers::CoexistingImpacts& one : all.motions)
    result.motions.push_back(sampled(std::move(one), all.starts, problem, scene, model));
  return result;
}

Motions phase_motions(const Scene& scene, const StructureModel& model, const solvers::Observer& observer) {
  solvers::ContactProblem problem = compose_problem(balance_of(scene, least_start_functions(scene)), model);
  const Analysis& analysis = scene.analysis;
  solvers::CoexistingMotions all = solvers::coexisting_motions(problem, scene.forcing.frequency,
                                                               {.random_starts = analysis.random_starts,
                                                                .seed = static_cast<unsigned>(analysis.seed),
                                                                .longest = analysis.longest_period,
                                                                .tolerance = scene.time.tolerance,
                                                                .observer = observer});
  Motions result{.status = std::string(to_string(all.status)),
                 .unsolved = std::move(all.unsolved),
                 .starts = all.starts,
                 .none = all.none,
                 .box = std::move(all.box)};
  for (solvers::CoexistingMotion& one : all.motions)
    result.motions.push_back(sampled(std::move(one), problem, scene, model));
  return result;
}

}  // namespace

Motions coexisting_motions(const Scene& scene, const StructureModel& model,
                           const solvers::Observer& observer) {
  const auto start = std::chrono::steady_clock::now();
  Motions result = solves_by_impacts(scene) ? impact_motions(scene, model, observer)
                                            : phase_motions(scene, model, observer);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace wavebalance::app
