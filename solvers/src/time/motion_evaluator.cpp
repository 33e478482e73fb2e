#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::solvers {

MotionEvaluator::MotionEvaluator(const AnyTimeBasis& trial, int points)
    : functions_(trial.functions()), points_(points), values_(trial, points, 0) {
  if (trial.pointwise_derivatives() >= 1) {
    rates_.emplace(trial, points, 1);
  } else {
    cells_.emplace(trial, functions_, 0);
  }
}

Eigen::VectorXd MotionEvaluator::displacement(const Eigen::VectorXcd& coefficients) {
  return values_(coefficients);
}

Eigen::VectorXd MotionEvaluator::velocity(const Eigen::VectorXcd& coefficients, double frequency) {
  if (rates_) return (*rates_)(coefficients)*frequency;
  return jump_velocity(coefficients, frequency);
}

Motion MotionEvaluator::operator()(const Eigen::MatrixXcd& coefficients, double frequency) {
  Motion motion{
      Eigen::MatrixXd(coefficients.cols(), points_), Eigen::MatrixXd(coefficients.cols(), points_), {}};
  for (Eigen::Index row = 0; row < coefficients.cols(); ++row) {
    const Eigen::VectorXcd one = coefficients.col(row);
    motion.displacement.row(row) = displacement(one);
    motion.velocity.row(row) = velocity(one, frequency);
  }
  return motion;
}

Eigen::VectorXd MotionEvaluator::jump_velocity(const Eigen::VectorXcd& coefficients, double frequency) {
  const Eigen::VectorXd cell = (*cells_)(coefficients);
  Eigen::VectorXd velocity(points_);
  for (int l = 0; l < points_; ++l) {
    const long long scaled = static_cast<long long>(l) * functions_;
    const int edge = static_cast<int>((scaled + points_ / 2) / points_) % functions_;
    const int before = edge == 0 ? functions_ - 1 : edge - 1;
    velocity[l] = (cell[edge] - cell[before]) * functions_ * frequency;
  }
  return velocity;
}

}  // namespace wavebalance::solvers
