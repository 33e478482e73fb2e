
#include "analysis/analysis_parts.hpp"
#include "outputs/peaks.hpp"
#include "outputs/point_measurer.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::app {
namespace {

/// Results of `measure` for each of so many points. Sets `cancelled` if the observer stops it.
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

/// 0: the curve; from 1: a branch.
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

/// Empty where the exact motion is not known at the peak itself.
MeasuredPoint exact_at_peak(const Scene& scene, const StructureModel& model,
                            const std::vector<Output>& outputs, const Sweep& sweep) {
  if (sweep.exact.empty() || scene.analysis.exact) return {};
  const ExactAlongSweep::Point& peak = sweep.exact.front().peak;
  if (!peak || !peak->motion || peak->place > 0) return {};
  PointMeasurer measurer(scene, model, outputs, compose_problem(scene, model), scene.analysis.subharmonic);
  return measurer(sweep.curve.points[peak_of(sweep.curve)], *peak->motion);
}

}  // namespace

MeasuredPoint exact_outputs(const Scene& scene, const StructureModel& model, const Response& response,
                            const std::vector<Output>& outputs) {
  const bool of_balance = response.solved_by == name_of(TimeMethod::balance);
  if (!of_balance || !response.exact || response.exact->motion.parts == nullptr) return {};
  Scene solved = scene;
  solved.time = solved_time(scene.time, response);
  PointMeasurer measurer(solved, model, outputs, compose_problem(solved, model), response.periods);
  solvers::SweepPoint point;
  point.frequency = scene.forcing.frequency;
  return measurer(point, response.exact->motion);
}

SweepOutputs measure_outputs(const Scene& scene, const StructureModel& model, Sweep& sweep,
                             const Observer& observer) {
  SweepOutputs found;
  if (sweep.curve.points.empty()) return found;
  found.outputs = outputs_of(scene);
  if (found.empty()) return found;
  bool& cancelled = sweep.outputs_cancelled;
  const bool stopped = sweep.stopped();  // by an observer that would stop this, too
  const Observer watch = stopped ? Observer() : observer;
  const auto measured = [&](const Sweep& of, std::size_t number) {
    return along_curve(scene, model, found.outputs, of, number, watch, cancelled);
  };
  for (std::size_t i = 0; i <= sweep.branches.size(); ++i) found.curves.push_back(measured(sweep, i));
  for (const Sweep& isola : sweep.isolas) found.isolas.push_back(measured(isola, 0));
  found.exact_at_peak = exact_at_peak(scene, model, found.outputs, sweep);
  if (!cancelled && !stopped) solve_for_peaks(scene, model, found, sweep, watch);
  const std::string wanted = peak_name(scene);
  for (std::size_t i = 0; i < found.outputs.size(); ++i) {
    if (wanted.empty() || (found.outputs[i].name != wanted && found.outputs[i].number != wanted)) continue;
    sweep.peak_of_output = highest(found.curves[0], i);
    if (i < found.peaks.size() && found.peaks[i].at.unknown.size() > 0) sweep.solved_peak = found.peaks[i].at;
  }
  return found;
}

}  // namespace wavebalance::app
