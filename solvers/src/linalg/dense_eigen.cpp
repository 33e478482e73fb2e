#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"
#include "linalg/multipliers.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::solvers::detail {
namespace {

Eigen::MatrixXd solve_triangular(const Eigen::MatrixXd& lower, const char* transpose, Eigen::MatrixXd right) {
  const lapack_int n = lapack_size(right.rows()), columns = lapack_size(right.cols());
  const double one = 1.0;
  if (right.size() > 0)
    dtrsm_("L", "L", transpose, "N", &n, &columns, &one, lower.data(), &n, right.data(), &n);
  return right;
}

}  // namespace

std::optional<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  lower.triangularView<Eigen::Lower>() = matrix;
  const lapack_int n = lapack_size(matrix.rows());
  if (n > 0 && LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, lower.data(), n) != 0) return std::nullopt;
  return lower;
}

Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right) {
  return solve_triangular(lower, "N", right);
}

Eigen::MatrixXd solve_lower_transposed(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right) {
  return solve_triangular(lower, "T", right);
}

std::optional<SymmetricEigen> symmetric_eigen(const Eigen::MatrixXd& matrix) {
  const lapack_int n = lapack_size(matrix.rows());
  SymmetricEigen result{Eigen::VectorXd(n), matrix};
  if (n == 0) return result;
  if (!matrix.allFinite() ||
      LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', n, result.vectors.data(), n, result.values.data()) != 0)
    return std::nullopt;
  return result;
}

std::optional<SymmetricEigen> symmetric_eigen(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& metric) {
  const auto lower = cholesky(metric);
  if (!lower) return std::nullopt;
  auto result = symmetric_eigen(solve_lower(*lower, solve_lower(*lower, matrix).transpose()));
  if (!result) return std::nullopt;
  result->vectors = solve_lower_transposed(*lower, result->vectors);
  if (!result->vectors.allFinite()) return std::nullopt;
  return result;
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  const lapack_int n = lapack_size(matrix.rows());
  Eigen::VectorXcd values = Eigen::VectorXcd::Constant(n, missing);
  if (n == 0 || !matrix.allFinite()) return values;
  Eigen::MatrixXd copy = matrix;
  Eigen::VectorXd real(n), imaginary(n);
  if (LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', n, copy.data(), n, real.data(), imaginary.data(), nullptr, 1,
                    nullptr, 1) != 0)
    return values;
  values.real() = real;
  values.imag() = imaginary;
  return values;
}

bool powers_vanish(Eigen::MatrixXd matrix) {
  constexpr int squarings = 12;
  constexpr double vanishing = 0.5, growing = 1e60;
  for (int k = 0;; ++k) {
    const double norm = matrix.norm();
    if (norm < vanishing) return true;
    if (k == squarings || !(norm < growing)) return false;
    matrix = product(matrix, matrix);
  }
}

int count_outside_circle(const Eigen::MatrixXd& matrix) {
  if (powers_vanish(matrix)) return 0;
  return count_outside(map_multipliers(matrix));
}

std::optional<GeneralEigen> general_eigen(const Eigen::MatrixXd& matrix) {
  const lapack_int n = lapack_size(matrix.rows());
  if (n == 0 || !matrix.allFinite()) return std::nullopt;
  Eigen::MatrixXd copy = matrix, packed(n, n);
  Eigen::VectorXd real(n), imaginary(n);
  if (LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'V', n, copy.data(), n, real.data(), imaginary.data(), nullptr, 1,
                    packed.data(), n) != 0)
    return std::nullopt;
  GeneralEigen result{Eigen::VectorXcd(n), packed.cast<std::complex<double>>()};
  result.values.real() = real;
  result.values.imag() = imaginary;
  // LAPACK stores the real and the imaginary part of the first vector of a conjugate pair.
  for (lapack_int i = 0; i + 1 < n; ++i) {
    if (!(imaginary[i] > 0.0)) continue;
    result.vectors.col(i).imag() = packed.col(i + 1);
    result.vectors.col(i + 1) = result.vectors.col(i).conjugate();
  }
  return result;
}

}  // namespace wavebalance::solvers::detail
