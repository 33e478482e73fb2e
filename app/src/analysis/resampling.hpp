#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace wavebalance::app {

/// The entry of `values`, uniform round the period, nearest to each of `points` uniform times; the later one
/// of two.
inline Eigen::VectorXd nearest_samples(const Eigen::VectorXd& values, int points) {
  const auto count = static_cast<std::int64_t>(values.size());
  return Eigen::VectorXd::NullaryExpr(points, [&](Eigen::Index l) {
    return values[static_cast<Eigen::Index>((2 * count * l + points) / (2 * std::int64_t{points}) % count)];
  });
}

}  // namespace wavebalance::app
