#include <algorithm>
#include <chrono>
#include <cmath>

#include "analysis/curve_events.hpp"
#include "analysis/exact_parts.hpp"
#include "analysis/impact_parts.hpp"
#include "analysis/response_parts.hpp"
#include "analysis/sweep_options.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::app {
namespace {

using solvers::ExactCurve, solvers::ExactEvent, solvers::ExactPoint, solvers::PhaseMotion;

/// What a curve's points are measured by.
struct Measure {
  solvers::SweepParameter parameter;
  double frequency;  ///< Hz, of an amplitude sweep
  const solvers::ContactLaws& laws;
  Eigen::VectorXd times;

  solvers::SweepPoint operator()(double value, const PhaseMotion& motion) const {
    const Eigen::MatrixXd u = motion.displacement(times), force = motion.force(times);
    solvers::SweepPoint point;
    const bool over_frequency = parameter == solvers::SweepParameter::frequency;
    point.frequency = over_frequency ? value : frequency;
    point.load_scale = over_frequency ? 1.0 : value;
    point.max_displacement = u.maxCoeff();
    for (const solvers::Impact& one : motion.impacts)  // where samples miss it
      point.max_displacement = std::max(
          point.max_displacement, motion.displacement(Eigen::VectorXd::Constant(1, one.time))(one.contact));
    point.min_displacement = u.minCoeff();
    point.max_abs_displacement = std::max(point.max_displacement, -point.min_displacement);
    const solvers::Vibration vibration = solvers::largest_vibration(u);
    point.vibration = vibration.half_peak_to_peak;
    point.rms_vibration = vibration.rms;
    point.rms_displacement = std::sqrt(u.rowwise().squaredNorm().maxCoeff() / double(times.size()));
    point.max_force = laws.largest_force(force);
    for (Eigen::Index c = 0; c < force.rows(); ++c)
      point.contact_fraction = std::max(point.contact_fraction, contact_share(motion, static_cast<int>(c)));
    point.residual = motion.residual;
    return point;
  }

 private:
  static double contact_share(const PhaseMotion& motion, int contact) {
    double share = 0.0;
    for (const solvers::ContactPhase& phase : motion.phases)
      if (phase.contact == contact) share += phase.length();
    return share;
  }
};

solvers::PointStability stability_of(const ExactPoint& point, const solvers::ContactLaws& laws) {
  solvers::PointStability stability;
  stability.status =
      point.unstable >= 0 ? solvers::StabilityStatus::converged : solvers::StabilityStatus::no_response;
  stability.unstable = point.unstable;
  stability.contacts = static_cast<int>(std::count_if(
      point.motion.phases.begin(), point.motion.phases.end(),
      [&](const solvers::ContactPhase& phase) {  // contacts with friction have phases in all their states
        return laws.begins(phase.contact) && !laws[phase.contact].friction();
      }));
  return stability;
}

/// The means over contacts and the work of all of them.
FrictionShares friction_of(const PhaseMotion& motion) {
  FrictionShares shares;
  for (const solvers::FrictionCycle& cycle : solvers::friction_cycles(motion))
    shares.add({cycle.work, cycle.stick_share, cycle.slip_share, cycle.open_share}, motion.friction.size());
  return shares;
}

SweepPhases::Point phases_of(const PhaseMotion& motion) {
  return solvers::PointPhases{motion.status, motion.estimated_error, solvers::missing};
}

void copy_events(const ExactCurve& curve, const Measure& measure, bool stability, Sweep& sweep) {
  for (const ExactEvent& event : curve.events) {
    const solvers::SpecialPoint point = special_point_of(event, measure(event.value, event.motion));
    if (event.type == solvers::SpecialPointType::fold)
      sweep.curve.turning_points.push_back(turning_point_at(point, false));
    if (!stability) continue;
    sweep.stability.special_points.push_back(point);
    sweep.phases.front().special_points.push_back(phases_of(event.motion));
  }
}

void copy_curve(const ExactCurve& curve, const Measure& measure, bool stability, Sweep& sweep) {
  sweep.curve.status = curve.status;
  sweep.curve.closed_at_start = curve.status == solvers::SweepStatus::closed;
  sweep.curve.parameter = measure.parameter;
  if (curve.status == solvers::SweepStatus::no_start && curve.start != solvers::PhasesStatus::converged)
    sweep.start_status = to_string(curve.start);
  SweepPhases& phases = sweep.phases.emplace_back();
  for (const ExactPoint& point : curve.points) {
    sweep.curve.points.push_back(measure(point.value, point.motion));
    phases.points.push_back(phases_of(point.motion));
    if (!stability) continue;
    sweep.stability.points.push_back(stability_of(point, measure.laws));
    solvers::MotionStability& found = phases.points.back()->stability.emplace();
    found.unstable = point.unstable;
    found.status = point.unstable < 0 ? "not_known" : point.unstable == 0 ? "stable" : "unstable";
    found.by_phases = true;
  }
  for (const std::size_t next : curve.unexplained) sweep.unexplained.push_back(curve.points[next].value);
  copy_events(curve, measure, stability, sweep);
  if (!curve.points.empty()) phases.peak = phases.points[peak_of(sweep.curve)];
}

}  // namespace

Sweep sweep_of(const ExactCurve& curve, const Scene& scene, const solvers::ContactProblem& problem) {
  const bool over_amplitude = scene.analysis.type == AnalysisType::amplitude_sweep;
  const auto parameter =
      over_amplitude ? solvers::SweepParameter::load_scale : solvers::SweepParameter::frequency;
  Sweep sweep;
  copy_curve(
      curve,
      {parameter, scene.forcing.frequency, problem.laws(), time_fractions(scene.analysis.output_points)},
      scene.analysis.stability, sweep);
  for (const ExactPoint& point : curve.points) sweep.exact_motions.push_back(point.motion);
  if (has_friction(scene)) {
    std::vector<FrictionShares>& shares = sweep.friction.emplace_back();
    for (const ExactPoint& point : curve.points) shares.push_back(friction_of(point.motion));
  }
  if (over_amplitude) sweep.amplitude_unit = reference_load(scene.forcing).value().unit;
  return sweep;
}

Sweep exact_sweep(const Scene& scene, const StructureModel& model, const Observer& observer,
                  const StartMotion& start) {
  require_start_fits(start, scene);
  const auto begin = std::chrono::steady_clock::now();
  const bool over_amplitude = scene.analysis.type == AnalysisType::amplitude_sweep;
  const solvers::ExactCurveOptions options = exact_options<solvers::ExactCurveOptions>(scene, observer);
  solvers::ContactProblem problem = exact_problem(scene, model);
  solvers::ForcedResponseOptions how;
  how.observer = observer;
  how.stay_near_guess = !start.contacts.empty();
  StartSamples samples;
  if (!start.contacts.empty()) samples = start_samples(start, scene);
  const solvers::ResponseStart at{samples.displacement, samples.force};
  const ExactCurve curve = over_amplitude
                               ? problem.exact_amplitude_sweep(scene.forcing.frequency, options, how, at)
                               : problem.exact_sweep(options, how, at);
  Sweep sweep = sweep_of(curve, scene, problem);
  sweep.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return sweep;
}

}  // namespace wavebalance::app
