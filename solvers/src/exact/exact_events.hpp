#pragma once
#include <complex>
#include <vector>

#include "exact/exact_path.hpp"

namespace wavebalance::solvers::detail {

/// Multipliers outside the unit circle; -1 where none are known.
int unstable_of(const Eigen::VectorXcd& multipliers);

/// The multiplier nearest to a place on the unit circle, Im >= 0; NaN where none is known.
std::complex<double> nearest(const Eigen::VectorXcd& multipliers, std::complex<double> place);

/// The special points between two neighbours with the same phases, in their order: folds, and with
/// `stability` where multipliers pass the unit circle. `multipliers` are those of the neighbours.
std::vector<ExactEvent> events_between(const PathModel& model, const PathPoint& a, const PathPoint& b,
                                       const Eigen::VectorXcd& of_a, const Eigen::VectorXcd& of_b);

}  // namespace wavebalance::solvers::detail
