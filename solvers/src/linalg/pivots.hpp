#pragma once
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace wavebalance::solvers {

/// An LU with a vanishing or non-finite pivot says that the matrix is singular; rcond() costs more than a
/// solve.
inline bool has_regular_pivots(const Eigen::PartialPivLU<Eigen::MatrixXd>& lu) {
  if (lu.rows() == 0) return true;
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  const double smallest = pivots.minCoeff();
  return std::isfinite(pivots.sum()) && smallest > std::numeric_limits<double>::min();
}

}  // namespace wavebalance::solvers
