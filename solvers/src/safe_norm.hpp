#pragma once
#include <Eigen/Core>
#include <cmath>

namespace wavebalance::solvers {

/// The Euclidean norm, also where the squares leave the range of numbers.
template <class Derived>
double safe_norm(const Eigen::MatrixBase<Derived>& values) {
  const double norm = values.norm();
  return norm > 1e-140 && std::isfinite(norm) ? norm : values.stableNorm();
}

}  // namespace wavebalance::solvers
