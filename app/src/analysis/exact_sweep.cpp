
#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::app {
namespace {

using solvers::ExactCurve, solvers::ExactEvent, solvers::ExactPoint, solvers::ExactSolution;

/// Measures of a curve's points.
struct Measure {
  solvers::SweepParameter parameter;
  double frequency;  ///< Hz, of an amplitude sweep
  const solvers::ContactLaws& laws;
  Eigen::VectorXd times;
  bool impulses;  ///< what an impact passes on is an impulse and not a force, so that points have none

  solvers::SweepPoint operator()(double value, const ExactSolution& motion) const {
    const Eigen::MatrixXd u = motion.displacement(times);
    solvers::SweepPoint point;
    const bool over_frequency = parameter == solvers::SweepParameter::frequency;
    point.frequency = over_frequency ? value : frequency;
    point.load_scale = over_frequency ? 1.0 : value;
    point.max_displacement = std::max(u.maxCoeff(), highest_at_impacts(motion));
    point.min_displacement = u.minCoeff();
    point.max_abs_displacement = std::max(point.max_displacement, -point.min_displacement);
    const solvers::Vibration vibration = solvers::largest_vibration(u);
    point.vibration = vibration.half_peak_to_peak;
    point.rms_vibration = vibration.rms;
    point.rms_displacement = std::sqrt(u.rowwise().squaredNorm().maxCoeff() / double(times.size()));
    point.max_force = impulses ? solvers::missing : laws.largest_force(motion.force(times));
    for (Eigen::Index c = 0; c < u.rows(); ++c)
      point.contact_fraction = std::max(point.contact_fraction, contact_share(motion, static_cast<int>(c)));
    point.residual = motion.residual;
    return point;
  }

 private:
  static double contact_share(const ExactSolution& motion, int contact) {
    double share = 0.0;
    for (const solvers::ForceInterval& interval : motion.intervals)
      if (interval.contact == contact) share += interval.length();
    return share;
  }
};

solvers::PointStability stability_of(const ExactPoint& point, const Measure& measure) {
  solvers::PointStability stability;
  stability.status =
      point.unstable >= 0 ? solvers::StabilityStatus::converged : solvers::StabilityStatus::no_response;
  stability.unstable = point.unstable;
  // Contacts with friction have intervals in all their states.
  const auto closed = std::ranges::count_if(point.motion.intervals, [&](const auto& interval) {
    return measure.laws.begins(interval.contact) && !measure.laws[interval.contact].friction();
  });
  stability.contacts = static_cast<int>(measure.impulses ? point.motion.impacts.size() : std::size_t(closed));
  return stability;
}

FrictionShares friction_of(const ExactSolution& motion, const std::vector<SceneContact>& places) {
  std::vector<ContactFriction> each;
  for (const solvers::FrictionCycle& cycle : motion.cycles)
    each.push_back(friction_at(places[std::size_t(cycle.row)], cycle));
  return FrictionShares(std::move(each));
}

ExactAlongSweep::Point exact_of(const ExactSolution& motion) {
  return solvers::ExactAtPoint{motion.status, motion.estimated_error, solvers::missing};
}

/// The impacts of a motion over several periods of the load.
PointImpacts impacts_of(const ExactSolution& motion, int periods) {
  PointImpacts result;
  result.count = static_cast<int>(motion.impacts.size());
  for (const solvers::Impact& impact : motion.impacts) {
    result.largest_impulse = std::max(result.largest_impulse, impact.impulse);
    result.largest_speed = std::max(result.largest_speed, impact.velocity_before);
    const auto contact = static_cast<std::size_t>(impact.contact);
    if (result.speeds.size() <= contact) result.speeds.resize(contact + 1, 0.0);
    result.speeds[contact] = std::max(result.speeds[contact], impact.velocity_before);
  }
  result.energy_lost = motion.energy_lost() / periods;
  return result;
}

/// A bifurcation or grazing point that was solved for with the parameter as unknown, with the measures of the
/// motion there.
solvers::SpecialPoint special_point_of(const ExactEvent& event, const solvers::SweepPoint& at) {
  solvers::SpecialPoint point;
  point.type = event.type;
  point.frequency = at.frequency;
  point.load_scale = at.load_scale;
  point.multiplier = event.multiplier;
  point.max_displacement = at.max_displacement;
  point.max_abs_displacement = at.max_abs_displacement;
  point.vibration = at.vibration;
  point.located = true;
  point.unknown_parameter = event.value;
  point.next_point = event.next_point;
  return point;
}

void copy_points(const ExactCurve& traced, const Measure& measure, bool stability,
                 solvers::FrequencySweep& curve, solvers::CurveStability& known) {
  curve.status = traced.status;
  curve.closed_at_start = traced.status == solvers::SweepStatus::closed;
  curve.parameter = measure.parameter;
  for (const ExactPoint& point : traced.points) {
    curve.points.push_back(measure(point.value, point.motion));
    if (stability) known.points.push_back(stability_of(point, measure));
  }
  for (const ExactEvent& event : traced.events) {
    const solvers::SpecialPoint point = special_point_of(event, measure(event.value, event.motion));
    if (event.type == solvers::SpecialPointType::fold || event.turns)
      curve.turning_points.push_back({point.frequency, point.max_displacement, point.max_abs_displacement,
                                      event.turns, point.load_scale});
    if (stability) known.special_points.push_back(point);
  }
}

void copy_impacts(const ExactCurve& traced, int periods, Sweep& sweep) {
  std::vector<PointImpacts>& impacts = sweep.impacts.emplace_back();
  for (const ExactPoint& point : traced.points) impacts.push_back(impacts_of(point.motion, periods));
}

void copy_motions(const ExactCurve& traced, Sweep& sweep) {
  std::vector<ExactSolution>& motions = sweep.exact_motions.emplace_back();
  for (const ExactPoint& point : traced.points) motions.push_back(point.motion);
}

/// The errors and the stability of each point.
ExactAlongSweep exact_of_sweep(const ExactCurve& traced, const solvers::FrequencySweep& curve,
                               bool stability) {
  ExactAlongSweep exact;
  for (const ExactPoint& point : traced.points) {
    exact.points.push_back(exact_of(point.motion));
    if (!stability) continue;
    solvers::MotionStability& found = exact.points.back()->stability.emplace();
    found.unstable = point.unstable;
    found.status = point.unstable < 0 ? "not_known" : point.unstable == 0 ? "stable" : "unstable";
    found.is_exact = true;
  }
  if (stability)
    for (const ExactEvent& event : traced.events) exact.special_points.push_back(exact_of(event.motion));
  if (!traced.points.empty()) exact.peak = exact.points[peak_of(curve)];
  return exact;
}

solvers::SweepParameter parameter_of(const Scene& scene) {
  return scene.analysis.type == AnalysisType::amplitude_sweep ? solvers::SweepParameter::load_scale
                                                              : solvers::SweepParameter::frequency;
}

Measure measure_of(const ExactCurve& curve, const Scene& scene, const solvers::ContactLaws& laws) {
  const bool impulses =
      solves_by_impacts(scene) && (curve.points.empty() || curve.points.front().motion.intervals.empty());
  return {parameter_of(scene), scene.forcing.frequency, laws, time_fractions(scene.analysis.output_points),
          impulses};
}

/// A curve of impacts from each period doubling, in their order.
void add_doubled_curves(const std::vector<ExactCurve>& curves, const Measure& measure, Sweep& sweep) {
  const std::vector<solvers::SpecialPoint>& points = sweep.stability.special_points;
  std::size_t next = 0;
  for (const ExactCurve& curve : curves) {
    while (points[next].type != solvers::SpecialPointType::period_doubling) ++next;
    solvers::Branch branch;
    branch.periods = 2;
    branch.special_point = static_cast<int>(next++);
    branch.end =
        curve.status == solvers::SweepStatus::ended ? solvers::BranchEnd::parent_curve : end_of(curve.status);
    copy_points(curve, measure, true, branch.curve, branch.stability);
    copy_impacts(curve, 2 * sweep.periods, sweep);
    copy_motions(curve, sweep);
    sweep.branches.push_back(std::move(branch));
  }
}

}  // namespace

Sweep sweep_of(const ExactCurve& curve, const Scene& scene, const solvers::ContactProblem& problem) {
  const Measure measure = measure_of(curve, scene, problem.laws());
  const bool stability = scene.analysis.stability;
  Sweep sweep;
  copy_points(curve, measure, stability, sweep.curve, sweep.stability);
  copy_motions(curve, sweep);
  for (const std::size_t next : curve.unexplained) sweep.unexplained.push_back(curve.points[next].value);
  if (curve.status == solvers::SweepStatus::no_start && curve.start != solvers::ExactStatus::converged)
    sweep.start_status = to_string(curve.start);
  if (measure.impulses) {
    if (!curve.points.empty())
      sweep.periods = sweep.motion_periods = static_cast<int>(
          std::lround(sweep.curve.points.front().frequency / curve.points.front().motion.frequency()));
  } else {
    sweep.exact.push_back(exact_of_sweep(curve, sweep.curve, stability));
  }
  if (measure.impulses || has_impacts(scene.contact)) copy_impacts(curve, sweep.periods, sweep);
  if (has_friction(scene)) {
    std::vector<FrictionShares>& shares = sweep.friction.emplace_back();
    const std::vector<SceneContact> places = contacts_of(scene);
    for (const ExactPoint& point : curve.points) shares.push_back(friction_of(point.motion, places));
  }
  if (parameter_of(scene) == solvers::SweepParameter::load_scale)
    sweep.amplitude_unit = reference_load(scene.forcing).value().unit;
  return sweep;
}

Sweep exact_sweep(const Scene& scene, const StructureModel& model, const Observer& observer,
                  const StartMotion& start) {
  require_start_fits(start, scene);
  const WallClock clock;
  const bool over_frequency = parameter_of(scene) == solvers::SweepParameter::frequency;
  const solvers::ExactCurveOptions options = exact_options(scene, observer);
  solvers::ContactProblem problem = exact_problem(scene, model);
  solvers::ForcedResponseOptions how;
  how.observer = observer;
  how.stay_near_guess = !start.contacts.empty();
  StartSamples samples;
  if (!start.contacts.empty()) samples = start_samples(start, scene);
  const solvers::ResponseStart at{samples.displacement, samples.force};
  const double frequency = over_frequency ? options.from : scene.forcing.frequency;
  const ExactCurve curve = over_frequency ? problem.exact_sweep(options, how, at)
                                          : problem.exact_amplitude_sweep(frequency, options, how, at);
  Sweep sweep = sweep_of(curve, scene, problem);
  if (model.contact_dynamics() == nullptr) sweep.start_status = "no_modes";
  if (scene.analysis.branches && curve.status != solvers::SweepStatus::cancelled && sweep.by_impacts())
    add_doubled_curves(problem.doubled_curves(curve, parameter_of(scene), frequency, options),
                       measure_of(curve, scene, problem.laws()), sweep);
  sweep.wall_seconds = clock.seconds();
  return sweep;
}

}  // namespace wavebalance::app
