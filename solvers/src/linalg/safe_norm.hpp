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

/// value / scale for numbers that are not negative; for a scale of 0 it is 1, or 0 if the value is 0 as well.
inline double relative_to(double scale, double value) {
  return scale > 0.0 ? value / scale : value > 0.0 ? 1.0 : value;
}

}  // namespace wavebalance::solvers
