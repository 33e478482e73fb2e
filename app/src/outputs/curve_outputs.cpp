#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/exact_parts.hpp"
#include "analysis/response_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/solvers/phases/structure_phases.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::app {
namespace {

/// Measures points of curves of one scene, over `periods` periods of the load.
class PointMeasurer {
 public:
  PointMeasurer(const Scene& scene, const StructureModel& model, const std::vector<Output>& outputs,
                solvers::ContactProblem problem, int periods)
      : outputs_(outputs),
        harmonics_(scene.analysis.output_harmonics),
        points_(scene.analysis.output_points),
        periods_(periods),
        over_amplitude_(scene.analysis.type == AnalysisType::amplitude_sweep),
        impacts_alone_(solves_by_impacts(scene)),
        problem_(std::move(problem)),
        evaluate_(problem_.pair().trial(), points_),
        rows_(rows_of_outputs(outputs, scene, model)) {}

  /// Of a balance.
  MeasuredPoint operator()(const solvers::FrequencySweep& curve, const solvers::SweepPoint& point) {
    const solvers::PeriodicResponse response =
        problem_.response(curve, parameter_of(point, curve.parameter), point.unknown);
    const solvers::Motion contacts = problem_.motion(response, points_);
    return measured(contacts.displacement, contacts.force, [&] {
      const Eigen::MatrixXcd all = problem_.condensed().full_coefficients(response.force_on_held_structure);
      return evaluate_((rows_ * all).transpose(), response.frequency).displacement;
    });
  }

  /// Of an exact motion. The force of an impact is not known.
  MeasuredPoint operator()(const solvers::SweepPoint& point, const solvers::PhaseMotion& motion) {
    const Eigen::VectorXd times = time_fractions(points_);
    const bool impulses = impacts_alone_ && motion.phases.empty();
    return measured(motion.displacement(times), impulses ? Eigen::MatrixXd() : motion.force(times), [&] {
      return Eigen::MatrixXd(rows_ *
                             solvers::structure_phases(held_at(point), motion, points_, precision_of(motion))
                                 .motion.displacement);
    });
  }

 private:
  /// `structure` gives the rows of outputs that are no contacts.
  template <class Structure>
  MeasuredPoint measured(const Eigen::MatrixXd& contacts, const Eigen::MatrixXd& forces,
                         const Structure& structure) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(rows_.rows(), points_);
    if (!rows_.isZero(0.0)) rows = structure();
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      if (outputs_[i].is_contact()) rows.row(Eigen::Index(i)) = contacts.row(outputs_[i].contact);
    return measure(outputs_, rows, forces, harmonics_, periods_);
  }

  // Relative errors of the displacements of contacts by the harmonics left out, below what a picture shows.
  // Harmonics fall like 1 / n^4 with elastic contacts and like 1 / n^2 with impacts.
  static solvers::StructurePhasesOptions precision_of(const solvers::PhaseMotion& motion) {
    if (motion.impacts.empty()) return {.tolerance = 1e-6};
    return {.tolerance = 1e-4, .max_harmonics = 2048};
  }

  solvers::CondensedProblem& held_at(const solvers::SweepPoint& point) {
    solvers::CondensedProblem& problem = problem_.condensed();
    problem.set_load_scale(over_amplitude_ ? point.load_scale : problem.full_load());
    problem.set_load_frequency(point.frequency);
    return problem;
  }

  const std::vector<Output>& outputs_;
  int harmonics_, points_, periods_;
  bool over_amplitude_, impacts_alone_;
  solvers::ContactProblem problem_;
  solvers::MotionEvaluator evaluate_;
  Eigen::MatrixXd rows_;
};

/// What `measure` finds of each of so many points. Sets `cancelled` where the observer stops it.
template <class Measure>
std::vector<MeasuredPoint> along(std::size_t points, const Observer& observer, bool& cancelled,
                                 const Measure& measure) {
  std::vector<MeasuredPoint> measured(points);
  for (std::size_t i = 0; i < points && !cancelled; ++i) {
    cancelled = !goes_on(observer, {"outputs", int(i)});
    if (!cancelled) measured[i] = measure(i);
  }
  return measured;
}

/// Of the curve, 0, or of a branch, from 1.
std::vector<MeasuredPoint> along_curve(const Scene& scene, const StructureModel& model,
                                       const std::vector<Output>& outputs, const Sweep& sweep,
                                       std::size_t number, const Observer& observer, bool& cancelled) {
  const solvers::FrequencySweep& curve = sweep.curve_of(number);
  const int times = number == 0 ? 1 : sweep.branches[number - 1].periods;
  if (curve.points.empty()) return {};
  if (sweep.exact_motions.empty()) {
    const Scene longer = number == 0 ? scene : with_longer_period(scene, times);
    PointMeasurer measurer(longer, model, outputs, compose_problem(longer, model),
                           longer.analysis.subharmonic);
    return along(curve.points.size(), observer, cancelled, [&](std::size_t i) {
      return curve.points[i].unknown.size() > 0 ? measurer(curve, curve.points[i]) : MeasuredPoint();
    });
  }
  const int periods = sweep.periods * times;
  solvers::ContactProblem problem = exact_problem(scene, model);
  PointMeasurer measurer(scene, model, outputs,
                         periods == 1 ? std::move(problem) : problem.over_periods(periods), periods);
  return along(curve.points.size(), observer, cancelled,
               [&](std::size_t i) { return measurer(curve.points[i], sweep.exact_motions[number][i]); });
}

/// The point with the largest vibration of an output; nothing where none was measured.
std::optional<std::size_t> highest(const std::vector<MeasuredPoint>& points, std::size_t output) {
  std::optional<std::size_t> best;
  const auto value = [&](std::size_t i) { return points[i][output].half_peak_to_peak(); };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].empty() && (!best || value(i) > value(*best))) best = i;
  return best;
}

/// Empty where the exact motion is not known at the peak itself.
MeasuredPoint exact_at_peak(const Scene& scene, const StructureModel& model,
                            const std::vector<Output>& outputs, const Sweep& sweep) {
  if (sweep.phases.empty() || scene.analysis.exact) return {};
  const SweepPhases::Point& peak = sweep.phases.front().peak;
  if (!peak || !peak->motion || peak->place > 0) return {};
  PointMeasurer measurer(scene, model, outputs, compose_problem(scene, model), scene.analysis.subharmonic);
  return measurer(sweep.curve.points[peak_of(sweep.curve)], *peak->motion);
}

}  // namespace

MeasuredPoint exact_outputs(const Scene& scene, const StructureModel& model, const Response& response,
                            const std::vector<Output>& outputs) {
  const bool of_balance = response.solved_by == name_of(TimeMethod::balance);
  if (!of_balance || !response.phases || response.phases->motion.parts == nullptr) return {};
  Scene solved = scene;
  solved.time = solved_time(scene.time, response);
  PointMeasurer measurer(solved, model, outputs, compose_problem(solved, model), response.periods);
  solvers::SweepPoint point;
  point.frequency = scene.forcing.frequency;
  return measurer(point, response.phases->motion);
}

SweepOutputs measure_outputs(const Scene& scene, const StructureModel& model, Sweep& sweep,
                             const Observer& observer) {
  SweepOutputs found;
  if (sweep.curve.points.empty()) return found;
  found.outputs = outputs_of(scene);
  if (found.empty()) return found;
  bool& cancelled = sweep.outputs_cancelled;
  const Observer watch = sweep.interrupted() ? Observer() : observer;
  const auto measured = [&](const Sweep& of, std::size_t number) {
    return along_curve(scene, model, found.outputs, of, number, watch, cancelled);
  };
  for (std::size_t i = 0; i <= sweep.branches.size(); ++i) found.curves.push_back(measured(sweep, i));
  for (const Sweep& isola : sweep.isolas) found.isolas.push_back(measured(isola, 0));
  found.exact_at_peak = exact_at_peak(scene, model, found.outputs, sweep);
  for (std::size_t i = 0; i < found.outputs.size(); ++i)
    if (found.outputs[i].name == scene.analysis.peak_of) sweep.peak_of_output = highest(found.curves[0], i);
  return found;
}

}  // namespace wavebalance::app
