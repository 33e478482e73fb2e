#include "problem/motion_samples.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::solvers::detail {
namespace {

constexpr double same_motion = 1e-6;  // relative distance of displacements

// The columns from `first` on, as many as `count`, of values that repeat.
Eigen::MatrixXd columns_from(const Eigen::MatrixXd& values, Index first, Index count) {
  Eigen::MatrixXd columns(values.rows(), count);
  for (Index l = 0; l < count; ++l) columns.col(l) = values.col((first + l) % values.cols());
  return columns;
}

// Difference of `one` from `other` shifted by `periods` forcing periods.
double distance_after(const MotionSamples& one, const MotionSamples& other, int periods) {
  const Eigen::MatrixXd& later = other.contacts.displacement;
  return (one.contacts.displacement - columns_from(later, periods * other.shift(), later.cols())).norm();
}

bool agree_after(const MotionSamples& one, const MotionSamples& other, int periods) {
  return distance_after(one, other, periods) <=
         same_motion * std::max(one.contacts.displacement.norm(), other.contacts.displacement.norm());
}

// The first of some motions of as many periods that `agrees` with another, some periods of the load later.
template <class Agrees>
std::optional<std::size_t> find_if_any(const std::vector<MotionSamples>& motions, int periods,
                                       const Agrees& agrees) {
  for (std::size_t i = 0; i < motions.size(); ++i)
    for (int later = 0; motions[i].periods == periods && later < periods; ++later)
      if (agrees(motions[i], later)) return i;
  return std::nullopt;
}

}  // namespace

MotionSamples samples_of(const ExactSolution& motion, int periods) {
  const int points = periods * points_of_period;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  return {{motion.displacement(times), motion.velocity(times), motion.force(times)}, periods};
}

std::optional<std::size_t> find_among(const std::vector<MotionSamples>& motions,
                                      const MotionSamples& motion) {
  return find_if_any(motions, motion.periods,
                     [&](const auto& one, int later) { return agree_after(motion, one, later); });
}

std::optional<std::size_t> find_near(const std::vector<MotionSamples>& motions, const MotionSamples& motion,
                                     double share) {
  const Eigen::MatrixXd& values = motion.contacts.displacement;
  const double near = share * (values.colwise() - values.rowwise().mean()).norm();
  return find_if_any(motions, motion.periods,
                     [&](const auto& one, int later) { return distance_after(motion, one, later) <= near; });
}

void set_shares(CoexistingMotions& result) {
  const double n = result.starts;
  for (CoexistingMotion& one : result.motions) {
    if (result.starts == 0) break;
    one.share = one.arrivals / n;
    one.share_error = std::sqrt(one.share * (1.0 - one.share) / n);
  }
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
