#pragma once
#include <vector>

#include "impacts/impact_path.hpp"

namespace wavebalance::solvers::detail {

/// The zeros of what makes special points, between a place with a tangent and the one a step along it on the
/// same path: folds, branch points, period doublings and Neimark-Sacker points, in the order along the curve.
/// `of_last` and `of_next`: the multipliers at both; empty: folds alone are sought.
std::vector<ImpactEvent> impact_events(ImpactPath& path, const ImpactPlace& last, const ImpactPlace& next,
                                       double step, const Eigen::VectorXcd& of_last,
                                       const Eigen::VectorXcd& of_next);

}  // namespace wavebalance::solvers::detail
