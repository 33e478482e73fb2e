#include "problem/motion_samples.hpp"

#include <algorithm>

namespace wavebalance::solvers::detail {
namespace {

constexpr double same_motion = 1e-6;  // relative distance of displacements

// The columns from `first` on, as many as `count`, of values that repeat.
Eigen::MatrixXd columns_from(const Eigen::MatrixXd& values, Index first, Index count) {
  Eigen::MatrixXd columns(values.rows(), count);
  for (Index l = 0; l < count; ++l) columns.col(l) = values.col((first + l) % values.cols());
  return columns;
}

bool agree(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  return (one - other).norm() <= same_motion * std::max(one.norm(), other.norm());
}

}  // namespace

MotionSamples samples_of(const PhaseMotion& motion, int periods) {
  const int points = periods * points_of_period;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  return {{motion.displacement(times), motion.velocity(times), motion.force(times)}, periods};
}

bool agree_after(const MotionSamples& one, const MotionSamples& other, int periods) {
  const Eigen::MatrixXd& values = other.contacts.displacement;
  return agree(one.contacts.displacement, columns_from(values, periods * other.shift(), values.cols()));
}

int least_periods(const MotionSamples& motion) {
  for (int periods = 1; periods < motion.periods; ++periods)
    if (motion.periods % periods == 0 && agree_after(motion, motion, periods)) return periods;
  return motion.periods;
}

MotionSamples mean_with_later(const MotionSamples& one, int later) {
  const auto mean = [&](const Eigen::MatrixXd& values) -> Eigen::MatrixXd {
    return 0.5 * (values + columns_from(values, later * one.shift(), values.cols()));
  };
  return {{mean(one.contacts.displacement), {}, mean(one.contacts.force)}, one.periods};
}

MotionSamples first_periods(const MotionSamples& samples, int periods) {
  const Index count = periods * samples.shift();
  return {{samples.contacts.displacement.leftCols(count), {}, samples.contacts.force.leftCols(count)},
          periods};
}

}  // namespace wavebalance::solvers::detail
