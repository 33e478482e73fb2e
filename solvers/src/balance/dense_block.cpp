#include "balance/dense_block.hpp"

#include <utility>

namespace wavebalance::solvers {

// Eliminating x = r - E z - b y leaves (I + R E) z + R b y = R r and -(E^T c).z + (d - c.b) y = s - c.r.
bool DenseBlock::factorize(Reduction& reduction, Border border) {
  reduction_ = &reduction;
  border_ = std::move(border);
  const Eigen::Index count = reduction.count(), size = count + (border_.exists() ? 1 : 0);
  matrix_.resize(size, size);
  if (count > 0) reduction.fill(matrix_);
  if (border_.exists()) {
    if (count > 0) {
      matrix_.col(count).head(count) = reduction.read(border_.column);
      matrix_.row(count).head(count) = -reduction.motion_transposed(border_.row).transpose();
    }
    matrix_(count, count) = border_.corner - border_.row.dot(border_.column);
  }
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void DenseBlock::solve(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y) {
  const Eigen::Index count = reduction_->count();
  Eigen::VectorXd values(matrix_.rows());
  if (count > 0) values.head(count) = reduction_->read(r);
  if (border_.exists()) values[count] = s - border_.row.dot(r);
  if (values.size() > 0) values = lu_.solve(values);
  y = border_.exists() ? values[count] : 0.0;
  x = r;
  if (border_.exists()) x -= border_.column * y;
  if (count > 0) x -= reduction_->motion(values.head(count));
}

}  // namespace wavebalance::solvers
