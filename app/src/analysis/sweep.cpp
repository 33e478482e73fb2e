#include "wavebalance/app/analysis/sweep.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/response/motion_periods.hpp"

namespace wavebalance::app {
namespace {

bool keeps_unknowns(const Scene& scene) {
  return scene.analysis.stability || scene.analysis.exact_near || !scene.analysis.motion_at.empty() ||
         scene.analysis.isolas || scene.analysis.has_outputs() || has_friction(scene);
}

/// The first point of a sweep that starts near a motion, or that has several periods of the load, and the
/// curve from there on.
void follow_from(const Scene& scene, solvers::ContactProblem& problem,
                 solvers::FrequencySweepOptions& options, const StartMotion& start, Sweep& sweep) {
  const StartSamples samples = start.contacts.empty() ? StartSamples() : start_samples(start, scene);
  options.start.observer = options.observer;
  solvers::ForcedResponseOptions how = options.start;
  how.stay_near_guess = !start.contacts.empty();
  const auto first =
      problem.respond(scene.analysis.frequency_from, how, {samples.displacement, samples.force});
  sweep.start_distance = relative_distance(first.displacement, samples.displacement);
  sweep.periods = scene.analysis.subharmonic;
  sweep.motion_periods = solvers::motion_periods(problem.condensed(), first);
  sweep.curve = problem.sweep(options, first);
}

/// The same over the amplitude of the load.
void follow_amplitude_from(const Scene& scene, solvers::ContactProblem& problem,
                           solvers::FrequencySweepOptions& options, const StartMotion& start, Sweep& sweep) {
  const StartSamples samples = start_samples(start, scene);
  options.start.observer = options.observer;
  options.start.stay_near_guess = true;
  auto [curve, first] =
      problem.amplitude_sweep(scene.forcing.frequency, options, {samples.displacement, samples.force});
  sweep.curve = std::move(curve);
  sweep.start_distance = relative_distance(first.displacement, samples.displacement);
}

Sweep balance_sweep(const Scene& scene, const StructureModel& model, const Observer& observer,
                    const StartMotion& start, bool over_amplitude) {
  require_start_fits(start, scene);
  const WallClock clock;
  solvers::FrequencySweepOptions options = sweep_options(scene);
  options.observer = observer;
  options.keep_unknowns = keeps_unknowns(scene);
  Sweep sweep;
  if (over_amplitude) sweep.amplitude_unit = reference_load(scene.forcing).value().unit;
  solvers::ContactProblem problem = compose_problem(scene, model);
  const bool from_rest = start.contacts.empty();
  if (over_amplitude && from_rest)
    sweep.curve = problem.amplitude_sweep(scene.forcing.frequency, options);
  else if (over_amplitude)
    follow_amplitude_from(scene, problem, options, start, sweep);
  else if (scene.analysis.subharmonic == 1 && from_rest)
    sweep.curve = problem.sweep(options);
  else
    follow_from(scene, problem, options, start, sweep);
  if (has_friction(scene)) sweep.friction = {friction_along(scene, sweep.curve)};
  sweep.wall_seconds = clock.seconds();
  return sweep;
}

}  // namespace

std::string SweepAxis::label() const {
  return (quantity == "frequency" ? "Frequency (" : "Amplitude of the load (") + unit + ")";
}

namespace {

SweepAxis amplitude_axis(const std::string& unit) {
  return {"amplitude", unit, unit == "m/s^2" ? "m_per_s2" : unit == "kg m" ? "kg_m" : unit};
}

}  // namespace

SweepAxis sweep_axis(const Sweep& sweep) {
  if (sweep.curve.parameter == solvers::SweepParameter::frequency) return {};
  return amplitude_axis(sweep.amplitude_unit);
}

SweepAxis sweep_axis(const Scene& scene) {
  if (!is_over_amplitude(scene.analysis)) return {};
  return amplitude_axis(std::string(reference_load(scene.forcing).value().unit));
}

bool Sweep::stopped() const {
  return interrupted() || stability.cancelled || exact_cancelled || isola_search.cancelled ||
         outputs_cancelled || !motions_left_out.empty() || std::ranges::any_of(isolas, &Sweep::stopped) ||
         std::ranges::any_of(branches,
                             [](const auto& branch) { return branch.end == solvers::BranchEnd::cancelled; });
}

std::size_t Sweep::peak() const { return peak_of_output ? *peak_of_output : peak_of(curve); }

bool Sweep::misses_part() const {
  const bool of_structure =
      structure_points && (structure_points->apart || !structure_points->passed_by.empty());
  return of_structure || std::ranges::any_of(isolas, [](const Sweep& one) { return one.origin.meets_known; });
}

std::string Sweep::status() const {
  if (interrupted()) return "interrupted";
  if (curve.rounding_error > largest_rounding_error) return inaccurate_status(curve.rounding_error);
  const bool complete = curve.status == solvers::SweepStatus::reached_end || curve.closed_at_start;
  return complete && misses_part() ? "missed_part" : std::string(to_string(curve.status));
}

const ExactAlongSweep* Sweep::exact_of(std::size_t number) const {
  return number < exact.size() ? &exact[number] : nullptr;
}

StabilityAlong Sweep::stability_of(std::size_t number) const {
  return stability_along(balances_of(number), exact_of(number));
}

Sweep frequency_sweep(const Scene& scene, const Observer& observer) {
  return frequency_sweep(scene, make_model(scene, observer), observer);
}

Sweep frequency_sweep(const Scene& scene, const StructureModel& model, const Observer& observer,
                      const StartMotion& start) {
  return balance_sweep(scene, model, observer, start, false);
}

Sweep amplitude_sweep(const Scene& scene, const Observer& observer) {
  return amplitude_sweep(scene, make_model(scene), observer);
}

Sweep amplitude_sweep(const Scene& scene, const StructureModel& model, const Observer& observer,
                      const StartMotion& start) {
  return balance_sweep(scene, model, observer, start, true);
}

namespace {

/// Largest period of a branch over the period of the curve. Each doubling needs twice the functions and
/// points.
constexpr int largest_period = 4;

void add_branches(const Scene& scene, solvers::ContactProblem& problem, const Observer& observer,
                  Sweep& sweep) {
  solvers::BranchOptions options;
  options.sweep = sweep_options(scene);
  options.stability.output_points = scene.analysis.output_points;
  options.largest_period = largest_period;
  options.observer = observer;
  const auto pairs = [&](int periods) { return make_pair(with_longer_period(scene, periods).time); };
  sweep.branches = problem.branches(sweep.curve, sweep.stability, pairs, options);
  for (const solvers::Branch& branch : sweep.branches)
    if (has_friction(scene)) sweep.friction.push_back(friction_along(scene, branch.curve));
}

}  // namespace

void add_stability(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer) {
  if (!scene.analysis.stability || sweep.curve.points.empty() || !model.contact_dynamics()) return;
  solvers::ContactProblem problem = compose_problem(scene, model);
  sweep.stability =
      problem.stability(sweep.curve, scene.analysis.output_points, observer, scene.analysis.special_points);
  if (scene.analysis.branches && !sweep.stability.cancelled) add_branches(scene, problem, observer, sweep);
}

}  // namespace wavebalance::app
