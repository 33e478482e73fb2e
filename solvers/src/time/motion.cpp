#include "wavebalance/solvers/time/motion.hpp"

#include <cstdint>

namespace wavebalance::solvers {

Motion Motion::contact(int c) const {
  if (empty()) return {};
  Motion one{displacement.row(c), {}, {}};
  if (velocity.size() > 0) one.velocity = velocity.row(c);
  if (force.size() > 0) one.force = force.row(c);
  return one;
}

Eigen::MatrixXd by_contact(const Eigen::VectorXd& samples, int contacts) {
  return samples.reshaped(samples.size() / contacts, contacts).transpose();
}

Eigen::MatrixXd nearest_samples(const Eigen::MatrixXd& samples, int points) {
  const std::int64_t count = samples.cols();
  Eigen::MatrixXd nearest(samples.rows(), points);
  for (std::int64_t l = 0; l < points; ++l)
    nearest.col(l) = samples.col((2 * count * l + points) / (2 * std::int64_t{points}) % count);
  return nearest;
}

}  // namespace wavebalance::solvers
