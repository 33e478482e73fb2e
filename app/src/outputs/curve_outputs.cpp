#include <algorithm>
#include <cmath>
#include <cstddef>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::app {
namespace {

/// Measures points of curves of one scene.
class PointMeasurer {
 public:
  PointMeasurer(const Scene& scene, const StructureModel& model, const std::vector<Output>& outputs)
      : outputs_(outputs),
        harmonics_(scene.analysis.output_harmonics),
        points_(scene.analysis.output_points),
        periods_(scene.analysis.subharmonic),
        problem_(compose_problem(scene, model)),
        evaluate_(problem_.pair().trial(), points_),
        rows_(rows_of_outputs(outputs, scene, model)) {}

  MeasuredPoint operator()(const solvers::FrequencySweep& curve, const solvers::SweepPoint& point) {
    const solvers::PeriodicResponse response =
        problem_.response(curve, parameter_of(point, curve.parameter), point.unknown);
    const solvers::Motion contacts = problem_.motion(response, points_);
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(rows_.rows(), points_);
    if (!rows_.isZero(0.0)) {
      const Eigen::MatrixXcd all = problem_.condensed().full_coefficients(response.force_on_held_structure);
      motion = evaluate_((rows_ * all).transpose(), response.frequency).displacement;
    }
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      if (outputs_[i].is_contact())
        motion.row(Eigen::Index(i)) = contacts.displacement.row(outputs_[i].contact);
    return measure(outputs_, motion, contacts.force, harmonics_, periods_);
  }

 private:
  const std::vector<Output>& outputs_;
  int harmonics_, points_, periods_;
  solvers::ContactProblem problem_;
  solvers::MotionEvaluator evaluate_;
  Eigen::MatrixXd rows_;
};

/// Sets `cancelled` where the observer stops it.
std::vector<MeasuredPoint> along(const Scene& scene, const StructureModel& model,
                                 const std::vector<Output>& outputs, const solvers::FrequencySweep& curve,
                                 const Observer& observer, bool& cancelled) {
  std::vector<MeasuredPoint> measured(curve.points.size());
  if (curve.points.empty() || cancelled) return measured;
  PointMeasurer measurer(scene, model, outputs);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    cancelled = !goes_on(observer, {"outputs", int(i)});
    if (cancelled) break;
    if (curve.points[i].unknown.size() > 0) measured[i] = measurer(curve, curve.points[i]);
  }
  return measured;
}

/// The point with the largest vibration of an output; nothing where none was measured.
std::optional<std::size_t> highest(const std::vector<MeasuredPoint>& points, std::size_t output) {
  std::optional<std::size_t> best;
  const auto value = [&](std::size_t i) { return points[i][output].half_peak_to_peak(); };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].empty() && (!best || value(i) > value(*best))) best = i;
  return best;
}

}  // namespace

SweepOutputs measure_outputs(const Scene& scene, const StructureModel& model, Sweep& sweep,
                             const Observer& observer) {
  SweepOutputs found;
  const bool balance = sweep.impacts.empty() && !scene.analysis.exact;
  if (!balance || sweep.curve.points.empty()) return found;
  found.outputs = outputs_of(scene);
  if (found.empty()) return found;
  bool& cancelled = sweep.outputs_cancelled;
  const auto measured = [&](const Scene& of, const solvers::FrequencySweep& curve) {
    return along(of, model, found.outputs, curve, observer, cancelled);
  };
  found.curves.push_back(measured(scene, sweep.curve));
  for (const solvers::Branch& branch : sweep.branches)
    found.curves.push_back(measured(with_longer_period(scene, branch.periods), branch.curve));
  for (const Sweep& isola : sweep.isolas) found.isolas.push_back(measured(scene, isola.curve));
  for (std::size_t i = 0; i < found.outputs.size(); ++i)
    if (found.outputs[i].name == scene.analysis.peak_of) sweep.peak_of_output = highest(found.curves[0], i);
  return found;
}

}  // namespace wavebalance::app
