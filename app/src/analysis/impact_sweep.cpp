#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "analysis/curve_events.hpp"
#include "analysis/impact_parts.hpp"
#include "analysis/sweep_options.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::app {
namespace {

using solvers::ImpactCurve, solvers::ImpactEvent, solvers::ImpactMotion, solvers::ImpactPoint;

// What the points of a curve with impacts are measured by.
struct ImpactMeasure {
  solvers::SweepParameter parameter;
  double frequency;  // Hz, of an amplitude sweep
  Eigen::VectorXd times;

  solvers::SweepPoint operator()(double value, const ImpactMotion& motion) const {
    const Eigen::MatrixXd u = motion.displacement(times);
    solvers::SweepPoint point;
    const bool over_frequency = parameter == solvers::SweepParameter::frequency;
    point.frequency = over_frequency ? value : frequency;
    point.load_scale = over_frequency ? 1.0 : value;
    point.max_displacement = u.maxCoeff();
    for (const solvers::Impact& impact : motion.impacts)
      point.max_displacement =
          std::max(point.max_displacement,
                   motion.displacement(Eigen::VectorXd::Constant(1, impact.time))(impact.contact));
    point.min_displacement = u.minCoeff();
    point.max_abs_displacement = std::max(point.max_displacement, -point.min_displacement);
    const solvers::Vibration vibration = solvers::largest_vibration(u);
    point.vibration = vibration.half_peak_to_peak;
    point.rms_vibration = vibration.rms;
    point.rms_displacement = std::sqrt(u.rowwise().squaredNorm().maxCoeff() / double(times.size()));
    point.max_force = solvers::missing;
    point.contact_fraction = 0.0;
    point.residual = motion.residual;
    return point;
  }
};

PointImpacts impacts_of(const ImpactMotion& motion, int periods) {
  PointImpacts result;
  result.count = static_cast<int>(motion.impacts.size());
  for (const solvers::Impact& impact : motion.impacts) {
    result.largest_impulse = std::max(result.largest_impulse, impact.impulse);
    result.largest_speed = std::max(result.largest_speed, impact.velocity_before);
  }
  result.energy_lost = motion.energy_lost() / periods;
  return result;
}

void copy_impacts(const ImpactCurve& traced, const ImpactMeasure& measure, int periods, bool stability,
                  solvers::FrequencySweep& curve, solvers::CurveStability& known,
                  std::vector<PointImpacts>& impacts) {
  curve.status = traced.status;
  curve.parameter = measure.parameter;
  for (const ImpactPoint& point : traced.points) {
    curve.points.push_back(measure(point.value, point.motion));
    impacts.push_back(impacts_of(point.motion, periods));
    if (!stability) continue;
    solvers::PointStability& one = known.points.emplace_back();
    one.status =
        point.unstable >= 0 ? solvers::StabilityStatus::converged : solvers::StabilityStatus::no_response;
    one.unstable = point.unstable;
    one.contacts = impacts.back().count;
  }
  for (const ImpactEvent& event : traced.events) {
    const solvers::SpecialPoint point = special_point_of(event, measure(event.value, event.motion));
    if (event.type == solvers::SpecialPointType::fold || event.turns)
      curve.turning_points.push_back(turning_point_at(point, event.turns));
    if (stability) known.special_points.push_back(point);
  }
}

solvers::BranchEnd end_of(solvers::SweepStatus status) {
  using solvers::BranchEnd, solvers::SweepStatus;
  switch (status) {
    case SweepStatus::reached_end:
      return BranchEnd::to_end;
    case SweepStatus::returned:
      return BranchEnd::from_end;
    case SweepStatus::ended:
      return BranchEnd::parent_curve;
    case SweepStatus::closed:
      return BranchEnd::closed;
    case SweepStatus::no_start:
      return BranchEnd::no_start;
    case SweepStatus::point_limit:
      return BranchEnd::point_limit;
    case SweepStatus::cancelled:
      return BranchEnd::cancelled;
    default:
      return BranchEnd::lost;
  }
}

std::vector<ImpactMotion> motions_of(const ImpactCurve& curve) {
  std::vector<ImpactMotion> motions;
  for (const ImpactPoint& point : curve.points) motions.push_back(point.motion);
  return motions;
}

// One from each period doubling, in their order.
void copy_branches(const std::vector<ImpactCurve>& curves, const ImpactMeasure& measure, int periods,
                   bool outputs, Sweep& sweep) {
  const std::vector<solvers::SpecialPoint>& points = sweep.stability.special_points;
  std::size_t next = 0;
  for (const ImpactCurve& curve : curves) {
    while (points[next].type != solvers::SpecialPointType::period_doubling) ++next;
    solvers::Branch branch;
    branch.periods = 2;
    branch.special_point = static_cast<int>(next++);
    branch.end = end_of(curve.status);
    std::vector<PointImpacts>& impacts = sweep.impacts.emplace_back();
    copy_impacts(curve, measure, 2 * periods, true, branch.curve, branch.stability, impacts);
    sweep.branches.push_back(std::move(branch));
    if (outputs) sweep.impact_motions.push_back(motions_of(curve));
  }
}

}  // namespace

Sweep impact_sweep(const Scene& scene, const StructureModel& model, const Observer& observer) {
  const auto begin = std::chrono::steady_clock::now();
  const bool over_amplitude = scene.analysis.type == AnalysisType::amplitude_sweep;
  solvers::ImpactCurveOptions options = exact_options<solvers::ImpactCurveOptions>(scene, observer);
  Sweep sweep;
  if (over_amplitude) sweep.amplitude_unit = reference_load(scene.forcing).value().unit;
  sweep.curve.parameter =
      over_amplitude ? solvers::SweepParameter::load_scale : solvers::SweepParameter::frequency;
  sweep.impacts.emplace_back();
  if (model.contact_dynamics() == nullptr) {
    sweep.start_status = "no_modes";
    return sweep;
  }
  solvers::ContactProblem problem = impacts_problem(scene, model);
  solvers::ImpactResponse first;
  const ImpactCurve curve = over_amplitude
                                ? problem.impact_amplitude_sweep(scene.forcing.frequency, options, &first)
                                : problem.impact_sweep(options, &first);
  const ImpactMeasure measure{sweep.curve.parameter, scene.forcing.frequency,
                              time_fractions(scene.analysis.output_points)};
  if (first.lasts()) return exact_sweep(scene, model, observer, {});
  if (!first.motion.converged()) sweep.start_status = to_string(first.motion.status);
  sweep.periods = sweep.motion_periods = options.periods = first.load_periods;
  copy_impacts(curve, measure, first.load_periods, scene.analysis.stability, sweep.curve, sweep.stability,
               sweep.impacts.front());
  const bool outputs = scene.analysis.has_outputs();
  if (outputs) sweep.impact_motions.push_back(motions_of(curve));
  if (scene.analysis.branches && curve.status != solvers::SweepStatus::cancelled)
    copy_branches(problem.impact_branches(curve, sweep.curve.parameter,
                                          over_amplitude ? scene.forcing.frequency : options.from, options),
                  measure, first.load_periods, outputs, sweep);
  sweep.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return sweep;
}

}  // namespace wavebalance::app
