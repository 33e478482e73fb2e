#include "wavebalance/app/analysis/sweep.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// The bifurcation points near which exact solutions are computed, in the order of the curve.
std::vector<std::size_t> special_points_taken(const std::vector<solvers::SpecialPoint>& points, bool all) {
  std::vector<std::size_t> taken(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) taken[i] = i;
  if (all || points.size() <= most_special_points_with_exact) return taken;
  std::stable_partition(taken.begin(), taken.end(),
                        [&](std::size_t i) { return points[i].type != solvers::SpecialPointType::grazing; });
  taken.resize(most_special_points_with_exact);
  std::ranges::sort(taken);
  return taken;
}

/// A curve with exact solutions.
struct CurveWithExact {
  const Scene& scene;  ///< with the period of the curve
  const StructureModel& model;
  const solvers::FrequencySweep& curve;
  const std::vector<solvers::SpecialPoint>& special_points;
  bool has_peak;
};

using Tries = std::vector<solvers::CurvePlace>;

Tries tries_at(const solvers::FrequencySweep& curve, std::size_t point) {
  return {{parameter_of(curve.points[point], curve.parameter), curve.points[point].unknown}};
}

/// Adds points of the curve before `before` and from `after` on: the nearest and some further away, because
/// near a fold several are beyond the exact fold.
void add_points_beside(Tries& tries, const solvers::FrequencySweep& curve, std::size_t before,
                       std::size_t after) {
  for (const std::size_t steps : {0, 3}) {
    if (before > steps) tries.push_back(tries_at(curve, before - 1 - steps).front());
    if (after + steps < curve.points.size()) tries.push_back(tries_at(curve, after + steps).front());
  }
}

/// Where exact solutions are computed: at the selected points, at the peak if the curve has one, and with
/// analysis.phases at all points.
std::vector<Tries> tries_along(const CurveWithExact& of, const std::vector<std::size_t>& special_points) {
  std::vector<Tries> all;
  for (const std::size_t i : special_points) {
    const solvers::SpecialPoint& point = of.special_points[i];
    Tries& tries = all.emplace_back(Tries{{point.unknown_parameter, point.unknown}});
    add_points_beside(tries, of.curve, point.next_point, point.next_point);
  }
  if (of.has_peak) {
    const std::size_t peak = peak_of(of.curve);
    add_points_beside(all.emplace_back(tries_at(of.curve, peak)), of.curve, peak, peak + 1);
  }
  for (std::size_t i = 0; of.scene.analysis.exact_near && i < of.curve.points.size(); ++i)
    all.push_back(tries_at(of.curve, i));
  return all;
}

/// About the operations of 20 points of a curve with 24 contacts and their panels.
constexpr double most_operations = 1.5e9;
constexpr int most_cut_panels = 30;

/// The errors of single responses need no more digits. Where no motion is near, as beyond a fold, the
/// search takes longest, and the neighbouring points are tried next.
solvers::CollocationOptions exact_options(bool all) {
  solvers::CollocationOptions options;
  options.max_operations = most_operations;
  options.max_cut_panels = most_cut_panels;
  options.tolerance = 1e-6;
  if (all) return options;
  options.max_iterations = 6;
  options.max_changes = 2;
  return options;
}

/// Sets `cancelled` where the observer stops it.
ExactAlongSweep exact_of(const CurveWithExact& of, const Observer& observer, bool& cancelled) {
  const bool all = of.scene.analysis.exact_near;
  const std::vector<std::size_t> taken = !seeks_exact_points(of.scene)
                                             ? std::vector<std::size_t>()
                                             : special_points_taken(of.special_points, all);
  solvers::ExactAlongOptions options;
  options.exact = exact_options(all);
  options.stability = all && of.scene.analysis.stability;
  if (of.has_peak) options.kept = taken.size();
  options.threads = of.model.threads;
  options.observer = observer;
  auto found = solvers::exact_along([&] { return compose_problem(of.scene, of.model); }, of.curve,
                                    tries_along(of, taken), options);
  cancelled = found.cancelled;
  ExactAlongSweep result;
  result.special_points.resize(of.special_points.size());
  auto next = found.points.begin();
  for (const std::size_t i : taken) result.special_points[i] = std::move(*next++);
  if (of.has_peak) result.peak = std::move(*next++);
  result.points.assign(next, found.points.end());
  return result;
}

/// With this tolerance of motions the frequencies of bifurcation points have eight digits.
constexpr double enough_for_special_points = 1e-6;

/// Exact points along the main curve, with more effort if all of its exact motions are requested.
void add_structure_points(const Scene& scene, const StructureModel& model, Sweep& sweep,
                          const Observer& observer) {
  if (sweep.exact_cancelled) return;
  const solvers::FrequencySweepOptions balance = sweep_options(scene);
  solvers::StructurePointsOptions options;
  options.from = balance.from;
  options.to = balance.to;
  options.first_step = std::min(options.first_step, balance.arc_length.initial_step);
  options.largest_step = balance.arc_length.max_step;
  options.exact.max_operations = most_operations;
  options.exact.max_cut_panels = most_cut_panels;
  options.exact.tolerance = enough_for_special_points;
  if (scene.analysis.exact_near) options.max_operations *= 10.0;
  options.threads = model.threads;
  options.observer = observer;
  sweep.structure_points = solvers::structure_points([&] { return compose_problem(scene, model); },
                                                     sweep.curve, sweep.stability.special_points, options);
  sweep.exact_cancelled = sweep.structure_points->cancelled;
}

}  // namespace

bool seeks_exact_points(const Scene& scene) {
  constexpr int few_contacts = 6, few_unknowns = 400;
  const int contacts = contact_count(scene);
  return scene.analysis.exact_near || contacts <= few_contacts ||
         contacts * scene.time.functions <= few_unknowns;
}

std::size_t peak_of(const solvers::FrequencySweep& curve) {
  const auto highest = std::ranges::max_element(
      curve.points, [](const auto& a, const auto& b) { return a.max_displacement < b.max_displacement; });
  return static_cast<std::size_t>(highest - curve.points.begin());
}

std::size_t vibration_peak_of(const solvers::FrequencySweep& curve) {
  const auto most = std::ranges::max_element(
      curve.points, [](const auto& a, const auto& b) { return a.vibration < b.vibration; });
  return static_cast<std::size_t>(most - curve.points.begin());
}

double error_of_vibration(const solvers::FrequencySweep& curve, const ExactAlongSweep::Point& peak,
                          int output_points) {
  if (!peak || !peak->motion || peak->place > 0) return solvers::missing;
  const double exact =
      solvers::largest_vibration(peak->motion->displacement(time_fractions(output_points))).half_peak_to_peak;
  return std::abs(curve.points[peak_of(curve)].vibration - exact) / exact;
}

std::string exact_status(const ExactAlongSweep::Point& point) {
  if (!point) return "not_computed";
  const bool beside = point->place > 0 && point->status == solvers::ExactStatus::converged;
  return std::string(to_string(point->status)) + (beside ? "_beside" : "");
}

bool was_not_found(const ExactAlongSweep::Point& point) {
  return point && point->status == solvers::ExactStatus::not_found;
}

StabilityAlong stability_along(const solvers::CurveStability& balance, const ExactAlongSweep* exact) {
  StabilityAlong along;
  along.points = balance.points;
  const bool with_exact = exact != nullptr && !exact->points.empty();
  for (std::size_t i = 0; i < along.points.size(); ++i) {
    solvers::PointStability& point = along.points[i];
    std::string by = "balance", status(to_string(point.status));
    if (with_exact && was_not_found(exact->points[i])) {
      point.unstable = -1;
      by = "none";
      status = exact_status(exact->points[i]);
    } else if (with_exact && exact->points[i] && exact->points[i]->stability) {
      const solvers::MotionStability& found = *exact->points[i]->stability;
      point.unstable = found.unstable;
      by = "phases";
      status = found.unstable < 0 ? found.status : "converged";
    }
    if (along.status == "converged") along.status = status;
    if (with_exact) along.by.push_back(std::move(by));
  }
  return along;
}

void add_exact(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer) {
  const bool wanted = scene.analysis.stability || scene.analysis.exact_near;
  if (!wanted || sweep.curve.points.empty() || sweep.stopped() || !model.contact_dynamics()) return;
  sweep.exact.push_back(exact_of({scene, model, sweep.curve, sweep.stability.special_points, true}, observer,
                                 sweep.exact_cancelled));
  // Along curves with friction or laws of several rows, which have no exact curves by collocation, this
  // needs as long as exact ones.
  const bool followed = !has_friction(scene) && !names_coupled_rows(scene.contact);
  if (scene.analysis.stability && scene.analysis.special_points && followed && seeks_exact_points(scene))
    add_structure_points(scene, model, sweep, observer);
  for (const solvers::Branch& branch : sweep.branches) {
    ExactAlongSweep& exact = sweep.exact.emplace_back();
    if (branch.curve.points.empty() || sweep.exact_cancelled) continue;
    const Scene longer = with_longer_period(scene, branch.periods);
    exact = exact_of({longer, model, branch.curve, branch.stability.special_points, false}, observer,
                     sweep.exact_cancelled);
  }
}

}  // namespace wavebalance::app
