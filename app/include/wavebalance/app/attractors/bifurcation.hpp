#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/attractors/recorded_motion.hpp"

namespace wavebalance::app {

/// The motion at one value of a diagram.
struct DiagramValue {
  double value = 0.0;    ///< Hz, or an amplitude in the unit of the load
  bool forwards = true;  ///< or on the way back
  int period = 0;        ///< periods of the load after which the motion repeats; 0: up to a quarter of the
                         ///< points it does not
  bool settles = false;  ///< without a period: its points come nearer to each other, so that it may have one
  /// Empty, or why there is no section: to_string(FlowStatus); the next value begins from rest.
  std::string failure = {};
  Eigen::MatrixXd displacement = {}, velocity = {};  ///< places x points of the section
  Eigen::VectorXd highest = {}, lowest = {};         ///< of each place over all recorded periods
  solvers::InvariantCurve curve = {};                ///< through the section of a motion without a period

  bool is_quasi_periodic() const {
    return failure.empty() && period == 0 && !settles && curve.residual <= largest_curve_residual;
  }
};

/// The points of a section that differ: one period if the motion repeats.
int points_shown(const DiagramValue& value);

/// A line of the exact curve, in the section: a motion of p periods has p of them.
struct ExactLine {
  int branch = 0;   ///< 0 of the curve, from 1 of its branches and of the curve from the other end
  int periods = 1;  ///< of the load
  std::vector<double> value = {}, displacement = {}, velocity = {};
  std::vector<int> unstable = {};  ///< multipliers outside the unit circle; -1 where not known
};

/// Poincare sections over the frequency or the amplitude of the load.
struct Diagram {
  SweepAxis axis;
  std::vector<MotionPlace> places = {};
  int place = 0;  ///< the one that is drawn: the first output, or the contact that moves most
  std::vector<DiagramValue> values = {};
  std::vector<ExactLine> exact = {};
  /// The curve from the other end, followed if the first did not reach it; else empty.
  std::string exact_status_back = {};
  std::string exact_status;  ///< of the exact curve; "not_sought", or "refused" where the scene has none
  std::string status;  ///< "converged", "interrupted", "no_modes", "incomplete" with a failure or "grows"
  double wall_seconds = 0.0;
};

/// A scene with analysis.type = "bifurcation_diagram": at each value, from the last state of the value
/// before, analysis.transient_periods pass by and analysis.section_points are recorded, one at the beginning
/// of each period of the load, and then once more on the way back. The exact curve is exact_sweep() of the
/// same scene over the same interval. An observer that stops it leaves the values so far.
Diagram bifurcation_diagram(const Scene& scene, const StructureModel& model, const Observer& observer = {});

}  // namespace wavebalance::app
