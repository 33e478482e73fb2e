#include "balance/dense_block.hpp"

namespace wavebalance::solvers {

// x = r - E z.
void DenseBlock::complete(const Eigen::VectorXd& r, const Eigen::VectorXd& values, Eigen::VectorXd& x) {
  x = r;
  if (count() > 0) x -= reduction_->motion(values);
}

bool DenseBlock::factorize(Reduction& reduction) {
  reduction_ = &reduction;
  matrix_.resize(count(), count());
  if (count() > 0) reduction_->fill(matrix_);
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void DenseBlock::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  Eigen::VectorXd values;
  if (count() > 0) values = lu_.solve(reduction_->read(r));
  complete(r, values, x);
}

// Eliminating x = r - E z - b y leaves (I + R E) z + R b y = R r and -(E^T c).z + (d - c.b) y = s - c.r.
bool DenseBlock::factorize_bordered(Reduction& reduction, const Eigen::VectorXd& b, const Eigen::VectorXd& c,
                                    double d) {
  reduction_ = &reduction;
  border_column_ = b;
  border_row_ = c;
  matrix_.resize(count() + 1, count() + 1);
  if (count() > 0) {
    reduction_->fill(matrix_);
    matrix_.col(count()).head(count()) = reduction_->read(b);
    matrix_.row(count()).head(count()) = -reduction_->motion_transposed(c).transpose();
  }
  matrix_(count(), count()) = d - c.dot(b);
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void DenseBlock::solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y) {
  Eigen::VectorXd values(count() + 1);
  values.head(count()) = reduction_->read(r);
  values[count()] = s - border_row_.dot(r);
  values = lu_.solve(values);
  y = values[count()];
  complete(r - border_column_ * y, values.head(count()), x);
}

}  // namespace wavebalance::solvers
