#include "compare/guide.hpp"

#include <utility>

#include "analysis/tolerance_response.hpp"
#include "wavebalance/app/compare/size_study.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {

std::optional<Guide> refined_guide(const Scene& scene, const StructureModel& model, double tolerance,
                                   const solvers::Observer& observer) {
  Scene refined = discretised(scene, {"fourier", "fourier"}, 0, 0);
  refined.time.tolerance = tolerance;
  ResponseOptions options;
  options.observer = observer;
  const solvers::ContactLaws laws = make_laws(scene);
  Response outcome;
  auto found = solve_to_tolerance(refined, model, laws, options, outcome);
  if (!outcome.converged || outcome.rounding_error > largest_rounding_error) return std::nullopt;
  const auto& last = found.levels.back();
  Guide guide{{std::move(*found.problem), laws, model.dynamics},
              std::move(found.response),
              {},
              found.estimated_error,
              last.functions,
              last.points};
  guide.contacts = guide.problem.motion(guide.response, scene.analysis.output_points);
  return guide;
}

std::optional<Guide> sized_guide(const Scene& scene, const StructureModel& model, int functions,
                                 const solvers::Observer& observer, const StartMotion& start) {
  const int points = 4 * (functions + 1);
  const Scene sized = discretised(scene, {"fourier", "fourier"}, functions, points);
  solvers::ContactProblem problem = uncondensed_problem(sized, model);
  solvers::ForcedResponseOptions options;
  options.form = scene.contact.form;
  options.observer = observer;
  options.stay_near_guess = !start.contacts.empty();
  solvers::PeriodicResponse response =
      problem.respond(scene.forcing.frequency, options, response_start(start, sized));
  if (!response.converged()) return std::nullopt;
  Guide guide{std::move(problem), std::move(response), {}, solvers::missing, functions, points};
  guide.contacts = guide.problem.motion(guide.response, scene.analysis.output_points);
  return guide;
}

}  // namespace wavebalance::app
