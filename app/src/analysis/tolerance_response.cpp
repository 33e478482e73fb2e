#include "analysis/tolerance_response.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

/// The pair of a scene that leaves it open: in the scenes of the benchmark of tolerances the cheapest choice
/// of the same error is mostly a pair of Fourier functions.
Scene with_pair(Scene scene) {
  if (scene.time.trial.empty()) scene.time.trial = scene.time.weight = "fourier";
  return scene;
}

solvers::LadderOptions ladder_options(const Scene& scene, const ResponseOptions& options) {
  solvers::LadderOptions ladder;
  ladder.tolerance = scene.time.tolerance;
  const bool wavelets = is_wavelet(scene.time.trial) || is_wavelet(scene.time.weight);
  if (wavelets) ladder.first_functions = 16;
  if (wavelets) ladder.first_points = 32;
  ladder.observer = options.observer;
  return ladder;
}

}  // namespace

solvers::LadderResponse solve_to_tolerance(const Scene& scene, const StructureModel& model,
                                           const solvers::ContactLaws& laws, const ResponseOptions& options,
                                           Response& result) {
  const Scene chosen = with_pair(scene);
  const auto make = [&](int functions, int points) {
    Scene rung = chosen;
    rung.time.functions = functions;
    rung.time.quadrature_points = points;
    return make_problem(rung, model);
  };
  auto found = solvers::response_to_tolerance(make, laws, ladder_options(chosen, options));
  result.converged = found.converged();
  result.status = to_string(found.status);
  result.residual = found.response.residual;
  result.strategy = to_string(found.response.strategy);
  result.condition = std::max(found.problem->condensation().condition(), found.response.condition);
  result.unknowns = model.contacts() * found.ladder.back().functions;
  for (const auto& rung : found.ladder) result.iterations += rung.iterations;
  result.refinement =
      Refinement{chosen.time.trial, chosen.time.weight, found.estimated_error, found.seconds, found.ladder};
  return found;
}

}  // namespace wavebalance::app
