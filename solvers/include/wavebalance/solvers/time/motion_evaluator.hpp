#pragma once
#include <Eigen/Core>
#include <optional>

#include "wavebalance/solvers/time/motion.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {

/// Displacement and velocity of periodic motions at uniform points of the period, for one trial basis.
///
/// Velocities are sum_j a_j q_j'(t) / T [JL14, eq. (34)]. Trial functions without a pointwise derivative
/// (Haar) use the jump between neighbouring cells divided by the cell width, placed at the cell edge and
/// held for half a cell on either side, which spreads the paper's delta functions over one cell. Owns
/// plans: one object per thread.
class MotionEvaluator {
 public:
  /// `points` as in the constructor of TrialEvaluator.
  MotionEvaluator(const AnyTimeBasis& trial, int points);

  int points() const { return points_; }
  /// m, `points` values, for coefficients given as their spectrum over translates (M/2 + 1).
  Eigen::VectorXd displacement(const Eigen::VectorXcd& coefficients);
  /// m/s; frequency in Hz.
  Eigen::VectorXd velocity(const Eigen::VectorXcd& coefficients, double frequency);
  /// Both of several motions, R x points without forces, for (M/2 + 1) x R coefficients.
  Motion operator()(const Eigen::MatrixXcd& coefficients, double frequency);

 private:
  Eigen::VectorXd jump_velocity(const Eigen::VectorXcd& coefficients, double frequency);

  int functions_;
  int points_;
  TrialEvaluator values_;
  std::optional<TrialEvaluator> rates_;  // empty when the trial functions have no pointwise derivative
  std::optional<TrialEvaluator> cells_;  // then: the values at l/M
};

}  // namespace wavebalance::solvers
