#pragma once

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::app {

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

  /// For a harmonic or wavelet balance.
  MeasuredPoint operator()(const solvers::FrequencySweep& curve, const solvers::SweepPoint& point) {
    return measured(curve, parameter_of(point, curve.parameter), point.unknown);
  }

  /// For a balance at a value of the curve's parameter.
  MeasuredPoint measured(const solvers::FrequencySweep& curve, double value, const Eigen::VectorXd& unknown) {
    const solvers::PeriodicResponse response = problem_.response(curve, value, unknown);
    solvers::CondensedProblem& problem = problem_.condensed();
    const LoadAt load{problem.load_frequency(), problem.load_factor(), periods_};
    const solvers::Motion contacts = problem_.motion(response, points_);
    solvers::Motion rows;
    if (!rows_.isZero(0.0)) {
      const Eigen::MatrixXcd all = problem.full_coefficients(response.force_on_held_structure);
      rows = evaluate_((rows_ * all).transpose(), response.frequency);
    }
    return measure(outputs_, values_of_outputs(outputs_, rows, contacts, load), contacts.force, harmonics_,
                   periods_);
  }

  /// For an exact motion. The force of an impact is not known.
  MeasuredPoint operator()(const solvers::SweepPoint& point, const solvers::ExactSolution& motion) {
    const Eigen::VectorXd times = time_fractions(points_);
    const bool impulses = impacts_alone_ && motion.intervals.empty();
    const solvers::Motion contacts{motion.displacement(times), {}, {}};
    solvers::CondensedProblem& problem = held_at(point);
    const LoadAt load{point.frequency, problem.load_factor(), periods_};
    solvers::Motion rows;
    if (!rows_.isZero(0.0)) {
      const solvers::Motion all =
          solvers::exact_structure_motion(problem, motion, points_, precision_of(motion)).motion;
      rows.displacement = rows_ * all.displacement;
      rows.velocity = rows_ * all.velocity;
    }
    return measure(outputs_, values_of_outputs(outputs_, rows, contacts, load),
                   impulses ? Eigen::MatrixXd() : motion.force(times), harmonics_, periods_);
  }

 private:
  // Relative errors of the displacements of contacts by the harmonics left out, below what a picture shows.
  // Harmonics fall like 1 / n^4 with elastic contacts and like 1 / n^2 with impacts.
  static solvers::ExactStructureOptions precision_of(const solvers::ExactSolution& motion) {
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

}  // namespace wavebalance::app
