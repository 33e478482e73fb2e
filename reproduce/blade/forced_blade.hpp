#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::blade {

/// The response at all contact nodes, contacts x points at uniform times of the period.
struct BladeResponse {
  double frequency = 0.0;  ///< Hz
  bool converged = false;
  Eigen::MatrixXd displacement;  ///< m
  Eigen::MatrixXd force;         ///< N
};

/// The responses at uniform frequencies from analysis.frequency_from to frequency_to, analysis.largest_step
/// apart, each from the one before, or from the linear response where that branch ends. Upwards this stays
/// on the branch of large responses, downwards on the branch of small ones. model: the scene's structure
/// composed before. O(frequencies) periodic problems.
std::vector<BladeResponse> stepped_sweep(const app::Scene& scene, const app::StructureModel& model);

/// The scene with frequencies from frequency_to to frequency_from.
app::Scene reversed(app::Scene scene);

/// The one at `frequency` (Hz), to half a step. Throws std::out_of_range.
const BladeResponse& at(const std::vector<BladeResponse>& responses, double frequency);

/// Largest displacement of any contact per response, m; NaN where it did not converge.
std::vector<double> largest_displacements(const std::vector<BladeResponse>& responses);

/// rms of the difference of two matrices of samples over the rms of the second. They have the same number of
/// columns, or one has a multiple of the other's: common times are compared.
double rms_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace wavebalance::blade
