#include "wavebalance/solvers/problem/isolated_curves.hpp"

#include <chrono>
#include <utility>

#include "analysis/sweep_options.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// The curves of the load's period that are known already.
std::vector<const solvers::FrequencySweep*> known_curves(const Sweep& sweep) {
  std::vector<const solvers::FrequencySweep*> curves{&sweep.curve};
  for (const solvers::Branch& branch : sweep.branches)
    if (branch.periods == 1) curves.push_back(&branch.curve);
  return curves;
}

/// A curve that was found, as a sweep of its own.
Sweep isola_of(const Scene& scene, const StructureModel& model, solvers::IsolatedCurve found,
               const Observer& observer) {
  Scene alone = scene;
  alone.analysis.branches = alone.analysis.isolas = false;
  Sweep isola;
  isola.curve = std::move(found.curve);
  isola.origin = {found.found_at, found.start, found.meets_known};
  if (has_friction(alone)) isola.friction = {friction_along(alone, isola.curve)};
  if (isola.interrupted()) return isola;
  add_stability(alone, model, isola, observer);
  add_phases(alone, model, isola, observer);
  return isola;
}

}  // namespace

void add_isolas(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer) {
  if (!scene.analysis.isolas || sweep.curve.points.empty() || sweep.stopped()) return;
  const auto begin = std::chrono::steady_clock::now();
  solvers::ContactProblem problem = compose_problem(scene, model);
  solvers::IsolatedCurvesOptions options;
  options.sweep = sweep_options(scene);
  options.sweep.observer = observer;
  options.spacing = scene.analysis.isola_spacing;
  options.random_starts = scene.analysis.isola_starts;
  solvers::IsolatedCurves found = solvers::isolated_curves(problem, known_curves(sweep), options);
  sweep.isola_search = {std::move(found.frequencies), std::move(found.unmatched), 1 + options.random_starts,
                        found.cancelled,
                        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
  for (solvers::IsolatedCurve& one : found.curves)
    sweep.isolas.push_back(isola_of(scene, model, std::move(one), observer));
}

}  // namespace wavebalance::app
