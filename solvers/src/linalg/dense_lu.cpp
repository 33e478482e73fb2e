#include "linalg/dense.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace wavebalance::solvers::detail {

template <class Scalar>
struct Lu<Scalar>::Factors {
  explicit Factors(const Matrix& matrix) : lu(matrix) {}
  Eigen::PartialPivLU<Matrix> lu;
};

template <class Scalar>
Lu<Scalar>::Lu() = default;

template <class Scalar>
Lu<Scalar>::Lu(const Matrix& matrix) {
  compute(matrix);
}

template <class Scalar>
void Lu<Scalar>::compute(const Matrix& matrix) {
  factors_ = matrix.rows() == 0 ? nullptr : std::make_shared<const Factors>(matrix);
}

template <class Scalar>
Eigen::Index Lu<Scalar>::size() const {
  return factors_ ? factors_->lu.rows() : 0;
}

template <class Scalar>
typename Lu<Scalar>::Matrix Lu<Scalar>::solve(const Matrix& right) const {
  return factors_ ? Matrix(factors_->lu.solve(right)) : right;
}

template <class Scalar>
typename Lu<Scalar>::Vector Lu<Scalar>::solve(const Vector& right) const {
  return factors_ ? Vector(factors_->lu.solve(right)) : right;
}

template <class Scalar>
typename Lu<Scalar>::Matrix Lu<Scalar>::inverse() const requires std::same_as<Scalar, double> {
  return factors_ ? Matrix(factors_->lu.inverse()) : Matrix();
}

template <class Scalar>
bool Lu<Scalar>::is_singular(double tolerance) const {
  if (!factors_) return false;
  const auto pivots = factors_->lu.matrixLU().diagonal().cwiseAbs();
  const double least = std::max(std::numeric_limits<double>::min(), tolerance * pivots.maxCoeff());
  return !std::isfinite(pivots.sum()) || pivots.minCoeff() <= least;
}

template <class Scalar>
double Lu<Scalar>::condition() const requires std::same_as<Scalar, double> {
  return factors_ ? 1.0 / factors_->lu.rcond() : 1.0;
}

template <class Scalar>
int Lu<Scalar>::determinant_sign() const requires std::same_as<Scalar, double> {
  if (!factors_) return 1;
  const auto negative = (factors_->lu.matrixLU().diagonal().array() < 0.0).count();
  return static_cast<int>(factors_->lu.permutationP().determinant()) * (negative % 2 == 0 ? 1 : -1);
}

template class Lu<double>;
template class Lu<std::complex<double>>;

}  // namespace wavebalance::solvers::detail
