#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/outputs.hpp"

namespace wavebalance::app {

/// Measures of an output over a period, in its unit; NaN if not known.
struct OutputMeasures {
  double max = std::numeric_limits<double>::quiet_NaN();
  double min = std::numeric_limits<double>::quiet_NaN();
  double highest = std::numeric_limits<double>::quiet_NaN();  ///< between the samples, by parabolas
  double lowest = std::numeric_limits<double>::quiet_NaN();
  double mean = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN();        ///< of the vibration, without its mean
  Eigen::VectorXcd harmonics = {};                              ///< of the load, from 1: moduli and phases
  double max_force = std::numeric_limits<double>::quiet_NaN();  ///< N, of a contact
  double contact_fraction = std::numeric_limits<double>::quiet_NaN();  ///< of a contact that opens

  double half_peak_to_peak() const { return 0.5 * (max - min); }
};

/// All outputs at one point of a curve; empty where the point was not measured.
using MeasuredPoint = std::vector<OutputMeasures>;

/// The load at a motion.
struct LoadAt {
  double frequency = 0.0;  ///< Hz
  double factor = 1.0;     ///< of the dynamic load of the scene; 0 for a free motion
  int periods = 1;         ///< of the load, in the motion
};

/// The values of outputs in their units, outputs x points, from the motion of their degrees of freedom
/// (rows_of_outputs() times the structure's) and of the contacts. Accelerations are the derivatives of the
/// velocities, by FFT. O(outputs points log points).
Eigen::MatrixXd values_of_outputs(const std::vector<Output>& outputs, const solvers::Motion& rows,
                                  const solvers::Motion& contacts, const LoadAt& load);

/// The same from the motion of the structure that is solved; it may be empty where all are contacts.
Eigen::MatrixXd values_of_outputs(const std::vector<Output>& outputs, const Scene& scene,
                                  const StructureModel& model, const solvers::Motion& contacts,
                                  const solvers::Motion& structure, const LoadAt& load);

/// Measures of `values`, outputs x points at uniform times of `periods` forcing periods, with `harmonics`
/// harmonics of the load. Forces are contact forces. O(outputs harmonics points).
MeasuredPoint measure(const std::vector<Output>& outputs, const Eigen::MatrixXd& values,
                      const Eigen::MatrixXd& forces, int harmonics, int periods);

/// The motion along a curve at which an output vibrates most, or is largest.
struct OutputPeak {
  solvers::CurvePeak at{.value = std::numeric_limits<double>::quiet_NaN()};
  OutputMeasures measures = {};  ///< there; of an exact curve at the nearest point
  bool solved = false;           ///< between the points of the curve, with its errors; or one of them
};

/// The outputs along a sweep.
struct SweepOutputs {
  std::vector<Output> outputs;
  std::vector<std::vector<MeasuredPoint>> curves;  ///< of the curve, then of each branch
  std::vector<std::vector<MeasuredPoint>> isolas;  ///< of each isola
  /// For each of analysis.outputs: the points of the curve with the largest half peak-to-peak value and the
  /// largest modulus.
  std::vector<OutputPeak> peaks = {}, largest = {};
  MeasuredPoint exact_at_peak = {};  ///< of the exact motion at the peak of the curve; empty where not known

  bool empty() const { return outputs.empty(); }
};

/// Measures the outputs of a scene at each point of a sweep of it, of its branches and of its isolas, and
/// sets the sweep's peak where analysis.peak_of names one. Nothing without outputs. A condensation for each
/// point. The points of a curve that was interrupted are solutions, and all of them are measured; otherwise
/// an observer that stops it leaves the other points unmeasured.
SweepOutputs measure_outputs(const Scene& scene, const StructureModel& model, Sweep& sweep,
                             const Observer& observer = {});

/// The outputs of the exact motion near a response of a balance; empty where that is not known. A
/// condensation.
MeasuredPoint exact_outputs(const Scene& scene, const StructureModel& model, const Response& response,
                            const std::vector<Output>& outputs);

/// Names of the columns of one output, and its cells; not numbers without measures.
std::vector<std::string> columns_of(const Output& output, int harmonics);
std::vector<double> cells_of(const Output& output, const OutputMeasures& measures, int harmonics);

}  // namespace wavebalance::app
