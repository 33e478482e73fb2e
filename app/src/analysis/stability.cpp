#include "analysis/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "analysis/summary_parts.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"

namespace wavebalance::app {
namespace {

/// Those of the trial functions, or fewer: at 127 harmonics exponents err by 1e-6 at most, and the cost grows
/// like the cube. The monodromy, which is taken where contact is too stiff for the harmonics, costs seconds
/// with many states. The operations take about ten seconds.
solvers::StabilityOptions options_for(const solvers::CondensedProblem& problem) {
  constexpr int most_harmonics = 255;
  solvers::StabilityOptions options;
  options.harmonics = std::clamp((problem.pair().functions() - 1) / 2, 1, most_harmonics);
  options.max_states = 120;
  options.max_operations = 3e10;
  return options;
}

std::string status_of(const solvers::UnstableMultipliers& count) {
  if (count.status != solvers::StabilityStatus::converged) return std::string(to_string(count.status));
  return count.count > 0 ? "unstable" : "stable";
}

/// Nothing where the structure has no modes to compute.
std::optional<solvers::ContactDynamics> dynamics_of(const solvers::LinearStructure& structure) {
  try {
    return solvers::ContactDynamics(structure);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::complex<double> leading_multiplier(const solvers::ContactDynamics& dynamics,
                                        const solvers::CondensedProblem& problem,
                                        const solvers::ContactLaws& laws,
                                        const solvers::PeriodicResponse& found) {
  solvers::FloquetOptions options;
  options.stability = options_for(problem);
  const auto exponents = solvers::floquet_exponents(dynamics, problem, laws, found, options);
  if (exponents.status != solvers::StabilityStatus::converged || exponents.values.empty())
    return {missing, missing};
  return exponents.values.front().multiplier;
}

std::vector<double> frequencies_of(const std::vector<solvers::TurningPoint>& turns) {
  std::vector<double> frequencies;
  for (const auto& turn : turns) frequencies.push_back(turn.frequency);
  return frequencies;
}

std::vector<double> folds_of(const solvers::CurveStability& stability) {
  std::vector<double> frequencies;
  for (const auto& point : stability.special_points)
    if (point.type == solvers::SpecialPointType::fold) frequencies.push_back(point.frequency);
  return frequencies;
}

/// Points where contact begins may hide no fold.
bool folds_are_known(const solvers::CurveStability& stability) {
  using solvers::StabilityStatus;
  return !stability.points.empty() &&
         std::all_of(stability.points.begin(), stability.points.end(), [](const auto& point) {
           return point.status == StabilityStatus::converged ||
                  point.status == StabilityStatus::too_few_samples;
         });
}

Table table_of(const std::vector<solvers::SpecialPoint>& points) {
  Table table({"type", "frequency_Hz", "bracket_Hz", "multiplier_real", "multiplier_imag",
               "max_displacement_m", "status"});
  for (const auto& point : points)
    table.append_row({std::string(to_string(point.type)), point.frequency, point.bracket,
                      point.multiplier.real(), point.multiplier.imag(), point.max_displacement,
                      std::string(point.located ? "located" : "bracketed")});
  return table;
}

void append_turning_points(Record& record, const Sweep& sweep, bool known) {
  const std::vector<double> of_samples = frequencies_of(sweep.curve.turning_points);
  const std::vector<double> folds = folds_of(sweep.stability);
  record.summary.emplace_back("turning_points_Hz", known ? folds : of_samples);
  if (!known || folds.size() >= of_samples.size()) return;
  record.summary.emplace_back("turning_points_of_samples_Hz", of_samples);
  record.warnings.push_back(fmt::format(
      "The curve turns {} times, but the motion has {} folds: the other turns are an error of the "
      "quadrature points.",
      of_samples.size(), folds.size()));
}

}  // namespace

ResponseStability response_stability(const solvers::CondensedProblem& problem,
                                     const solvers::ContactLaws& laws, const solvers::PeriodicResponse& found,
                                     const solvers::LinearStructure& structure) {
  const auto start = std::chrono::steady_clock::now();
  ResponseStability result;
  const auto dynamics = dynamics_of(structure);
  if (!dynamics) return result;
  const auto count = solvers::unstable_multipliers(*dynamics, problem, laws, found, options_for(problem));
  result.status = status_of(count);
  result.unstable = count.count;
  result.leading = count.leading;
  const bool known = std::isfinite(count.leading.real());
  if (count.status == solvers::StabilityStatus::converged && !known)
    result.leading = leading_multiplier(*dynamics, problem, laws, found);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void append_stability(Record& record, const ResponseStability& stability) {
  record.summary.emplace_back("stability", stability.status);
  if (stability.unstable >= 0)
    record.summary.emplace_back("unstable_multipliers", std::int64_t{stability.unstable});
  else
    record.summary.emplace_back("unstable_multipliers", missing);
  record.summary.emplace_back("leading_multiplier_real", stability.leading.real());
  record.summary.emplace_back("leading_multiplier_imag", stability.leading.imag());
  if (stability.unstable <= 0) return;
  record.warnings.push_back(fmt::format(
      "The response is unstable, with {} Floquet multiplier{} outside the unit circle: a structure "
      "that is disturbed leaves it.",
      stability.unstable, stability.unstable == 1 ? "" : "s"));
}

void add_stability(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer) {
  const auto dynamics = dynamics_of(model.structure);
  if (!scene.analysis.stability || sweep.curve.points.empty() || !dynamics) return;
  ComposedProblem composed = compose_problem(scene, model);
  solvers::CurveStabilityOptions options;
  options.stability = options_for(composed.problem);
  options.output_points = scene.analysis.output_points;
  options.observer = observer;
  sweep.stability =
      solvers::curve_stability(composed.problem, composed.laws, sweep.curve, *dynamics, options);
}

void append_stability(Record& record, const Sweep& sweep) {
  const bool complete = sweep.stability.points.size() == sweep.curve.points.size();
  append_turning_points(record, sweep, complete && folds_are_known(sweep.stability));
  if (sweep.stability.points.empty()) return;
  record.summary.emplace_back("stability",
                              complete ? std::string(to_string(sweep.stability.status())) : "interrupted");
  record.summary.emplace_back("special_points", table_of(sweep.stability.special_points));
}

Table sweep_table(const solvers::FrequencySweep& curve) {
  Table table({"frequency_Hz", "max_displacement_m", "rms_displacement_m"});
  for (const auto& point : curve.points)
    table.append_row({point.frequency, point.max_displacement, point.rms_displacement});
  return table;
}

Table sweep_table(const Sweep& sweep) {
  Table table = sweep_table(sweep.curve);
  const auto& points = sweep.stability.points;
  if (points.empty()) return table;
  std::vector<double> unstable(table.rows(), missing), contacts(table.rows(), missing);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].unstable >= 0) unstable[i] = points[i].unstable;
    contacts[i] = points[i].contacts;
  }
  return table.add_column("unstable", unstable).add_column("contacts", contacts);
}

}  // namespace wavebalance::app
