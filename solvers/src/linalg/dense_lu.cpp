#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The routines without LAPACKE's search for NaN.
void factorize(lapack_int n, double* matrix, lapack_int* pivots) {
  LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, matrix, n, pivots);
}

void factorize(lapack_int n, std::complex<double>* matrix, lapack_int* pivots) {
  LAPACKE_zgetrf_work(LAPACK_COL_MAJOR, n, n, matrix, n, pivots);
}

void substitute(char form, lapack_int n, lapack_int columns, const double* lu, const lapack_int* pivots,
                double* right) {
  LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, form, n, columns, lu, n, pivots, right, n);
}

void substitute(char form, lapack_int n, lapack_int columns, const std::complex<double>* lu,
                const lapack_int* pivots, std::complex<double>* right) {
  LAPACKE_zgetrs_work(LAPACK_COL_MAJOR, form, n, columns, lu, n, pivots, right, n);
}

}  // namespace

template <class Scalar>
struct Lu<Scalar>::Factors {
  explicit Factors(const Matrix& matrix) : lu(matrix), pivots(static_cast<std::size_t>(matrix.rows())) {
    if constexpr (std::same_as<Scalar, double>) norm = matrix.cwiseAbs().colwise().sum().maxCoeff();
    factorize(rows(), lu.data(), pivots.data());
  }

  lapack_int rows() const { return static_cast<lapack_int>(lu.rows()); }

  template <class Result>
  Result solve(Result right, char form = 'N') const {
    substitute(form, rows(), static_cast<lapack_int>(right.cols()), lu.data(), pivots.data(), right.data());
    return right;
  }

  Matrix lu;
  std::vector<lapack_int> pivots;  // row that changed places with each row, from 1
  double norm = 0.0;               // 1-norm of a real matrix
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
  return factors_ ? factors_->rows() : 0;
}

template <class Scalar>
typename Lu<Scalar>::Matrix Lu<Scalar>::solve(const Matrix& right) const {
  return factors_ ? factors_->solve(right) : right;
}

template <class Scalar>
typename Lu<Scalar>::Vector Lu<Scalar>::solve(const Vector& right) const {
  return factors_ ? factors_->solve(right) : right;
}

template <class Scalar>
typename Lu<Scalar>::Matrix Lu<Scalar>::solve_transposed(const Matrix& right) const {
  return factors_ ? factors_->solve(right, 'T') : right;
}

template <class Scalar>
typename Lu<Scalar>::Matrix Lu<Scalar>::inverse() const requires std::same_as<Scalar, double> {
  return factors_ ? factors_->solve(Matrix(Matrix::Identity(size(), size()))) : Matrix();
}

template <class Scalar>
bool Lu<Scalar>::is_singular(double tolerance) const {
  if (!factors_) return false;
  const auto pivots = factors_->lu.diagonal().cwiseAbs();
  const double least = std::max(std::numeric_limits<double>::min(), tolerance * pivots.maxCoeff());
  return !std::isfinite(pivots.sum()) || pivots.minCoeff() <= least;
}

template <class Scalar>
double Lu<Scalar>::condition() const requires std::same_as<Scalar, double> {
  if (!factors_) return 1.0;
  const lapack_int n = factors_->rows();
  std::vector<double> work(4 * static_cast<std::size_t>(n));
  std::vector<lapack_int> integers(static_cast<std::size_t>(n));
  double reciprocal = 0.0;
  if constexpr (std::same_as<Scalar, double>)
    LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', n, factors_->lu.data(), n, factors_->norm, &reciprocal,
                        work.data(), integers.data());
  return 1.0 / reciprocal;
}

template <class Scalar>
int Lu<Scalar>::determinant_sign() const requires std::same_as<Scalar, double> {
  if (!factors_) return 1;
  bool negative = (factors_->lu.diagonal().real().array() < 0.0).count() % 2 != 0;
  for (std::size_t i = 0; i < factors_->pivots.size(); ++i)
    if (factors_->pivots[i] != static_cast<lapack_int>(i) + 1) negative = !negative;
  return negative ? -1 : 1;
}

template <class Scalar>
std::complex<double> Lu<Scalar>::log_determinant() const requires std::same_as<Scalar, std::complex<double>> {
  if (!factors_) return 0.0;
  bool odd = false;
  for (std::size_t i = 0; i < factors_->pivots.size(); ++i)
    if (factors_->pivots[i] != static_cast<lapack_int>(i) + 1) odd = !odd;
  const std::complex<double> sign(0.0, odd ? std::numbers::pi : 0.0);
  return sign + factors_->lu.diagonal().array().log().sum();
}

// clang before 16 instantiates members whose requirement does not hold, too: their bodies compile for both
// types.
template class Lu<double>;
template class Lu<std::complex<double>>;

}  // namespace wavebalance::solvers::detail
