#include "wavebalance/solvers/problem/isolated_curves.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

constexpr int compared_points = 256;  // at which motions are compared

/// The curves of the load's period that are known already.
std::vector<const solvers::FrequencySweep*> known_curves(const Sweep& sweep) {
  std::vector<const solvers::FrequencySweep*> curves{&sweep.curve};
  for (const solvers::Branch& branch : sweep.branches)
    if (branch.periods == 1) curves.push_back(&branch.curve);
  return curves;
}

/// A curve that was found, as a separate sweep.
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
  add_exact(alone, model, isola, observer);
  return isola;
}

solvers::IsolatedCurvesOptions isolated_options(const Scene& scene, const Observer& observer) {
  solvers::IsolatedCurvesOptions options;
  options.sweep = sweep_options(scene);
  options.sweep.observer = observer;
  options.spacing = scene.analysis.isola_spacing;
  options.random_starts = scene.analysis.isola_starts;
  return options;
}

void note_search(Sweep& sweep, solvers::IsolatedCurves& found, int random_starts) {
  IsolaSearch& search = sweep.isola_search;
  search.frequencies = std::move(found.frequencies);
  search.unmatched = std::move(found.unmatched);
  search.starts = 1 + random_starts;
  search.cancelled = found.cancelled;
}

/// The motion between two, uniform over the period, at a share of the way.
solvers::Motion between(const solvers::ExactSolution& a, const solvers::ExactSolution& b, double share) {
  const Eigen::VectorXd times = time_fractions(compared_points);
  solvers::Motion motion;
  motion.displacement = (1.0 - share) * a.displacement(times) + share * b.displacement(times);
  motion.force = (1.0 - share) * a.force(times) + share * b.force(times);
  return motion;
}

/// Whether a motion at a frequency is one of an exact curve: of the motions of the curve there, which follow
/// from its neighbours by collocation, one agrees with it.
bool is_on(solvers::ContactProblem& problem, const Sweep& sweep, double frequency,
           const solvers::ExactSolution& motion) {
  constexpr double same = 1e-3;  // of what vibrates
  const Eigen::MatrixXd wanted = motion.displacement(time_fractions(compared_points));
  const double vibration = (wanted.colwise() - wanted.rowwise().mean()).norm();
  const std::vector<solvers::SweepPoint>& points = sweep.curve.points;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double share =
        (frequency - points[k - 1].frequency) / (points[k].frequency - points[k - 1].frequency);
    if (!(share >= 0.0 && share <= 1.0)) continue;
    const auto there = problem.exact_near(
        frequency, between(sweep.exact_motions.front()[k - 1], sweep.exact_motions.front()[k], share));
    if (!there || there->parts == nullptr) continue;
    if ((there->displacement(time_fractions(compared_points)) - wanted).norm() <= same * vibration)
      return true;
  }
  return false;
}

bool is_on_any(solvers::ContactProblem& problem, const Sweep& sweep, double frequency,
               const solvers::ExactSolution& motion) {
  return is_on(problem, sweep, frequency, motion) ||
         std::ranges::any_of(sweep.isolas,
                             [&](const Sweep& isola) { return is_on(problem, isola, frequency, motion); });
}

/// A curve of balances, followed exactly. Nothing where no motion of the structure was found near those at
/// the frequency where it was found, or one of a curve that is known.
void add_exact_isola(const Scene& scene, solvers::ContactProblem& problem,
                     const solvers::IsolatedCurve& found, const Observer& observer, Sweep& sweep) {
  const double at = found.found_at;
  for (const solvers::PeriodicResponse& response : problem.responses_at(found.curve, at)) {
    const auto near = problem.exact_near(response);
    if (!near || near->motion.parts == nullptr) continue;
    if (is_on_any(problem, sweep, at, near->motion)) return;
    const auto options = exact_options(scene, observer);
    Sweep isola = sweep_of(problem.exact_curve_from(at, near->motion, options), scene, problem);
    if (isola.curve.points.empty()) continue;
    isola.origin = {at, found.start, false};
    const auto meets = [&](const solvers::SweepPoint& end, const solvers::ExactSolution& motion) {
      return !isola.curve.closed_at_start && is_on_any(problem, sweep, end.frequency, motion);
    };
    isola.origin.meets_known = meets(isola.curve.points.front(), isola.exact_motions.front().front()) ||
                               meets(isola.curve.points.back(), isola.exact_motions.front().back());
    sweep.isolas.push_back(std::move(isola));
    return;
  }
  sweep.isola_search.unmatched.push_back(at);
}

void add_exact_isolas(const Scene& scene, const StructureModel& model, Sweep& sweep,
                      const Observer& observer) {
  Scene balance = scene;
  balance.analysis.exact = false;
  solvers::ContactProblem problem = compose_problem(balance, model);
  solvers::IsolatedCurvesOptions options = isolated_options(balance, observer);
  options.sweep.keep_unknowns = true;
  const solvers::FrequencySweep known = problem.sweep(options.sweep);
  if (known.status == solvers::SweepStatus::cancelled) {
    sweep.isola_search.cancelled = true;
    return;
  }
  solvers::IsolatedCurves found = solvers::isolated_curves(problem, {&known}, options);
  note_search(sweep, found, options.random_starts);
  for (const solvers::IsolatedCurve& one : found.curves)
    add_exact_isola(scene, problem, one, observer, sweep);
}

void add_balance_isolas(const Scene& scene, const StructureModel& model, Sweep& sweep,
                        const Observer& observer) {
  solvers::ContactProblem problem = compose_problem(scene, model);
  const solvers::IsolatedCurvesOptions options = isolated_options(scene, observer);
  solvers::IsolatedCurves found = solvers::isolated_curves(problem, known_curves(sweep), options);
  note_search(sweep, found, options.random_starts);
  for (solvers::IsolatedCurve& one : found.curves)
    sweep.isolas.push_back(isola_of(scene, model, std::move(one), observer));
}

}  // namespace

void add_isolas(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer) {
  if (!scene.analysis.isolas || sweep.curve.points.empty() || sweep.stopped()) return;
  const WallClock clock;
  const auto add = scene.analysis.exact ? add_exact_isolas : add_balance_isolas;
  add(scene, model, sweep, observer);
  sweep.isola_search.wall_seconds = clock.seconds();
}

}  // namespace wavebalance::app
