#include "analysis/tolerance_response.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/response_parts.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

/// A scene without a pair takes Fourier functions. In the benchmark of tolerances the cheapest choice of the
/// same error is mostly a pair of them.
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

}  // namespace

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

}  // namespace wavebalance::app
