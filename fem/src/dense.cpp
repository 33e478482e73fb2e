#include "dense.hpp"

#include <complex>
// The types of LAPACK's C interface are those of C unless they are given.
#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <cblas.h>
#include <lapacke.h>

namespace wavebalance::fem::detail {
namespace {

lapack_int size_of(Eigen::Index size) { return static_cast<lapack_int>(size); }

Eigen::MatrixXd multiply(const ConstMatrix& a, CBLAS_TRANSPOSE left, const ConstMatrix& b,
                         CBLAS_TRANSPOSE right) {
  const Eigen::Index rows = left == CblasTrans ? a.cols() : a.rows();
  const Eigen::Index columns = right == CblasTrans ? b.rows() : b.cols();
  const Eigen::Index inner = left == CblasTrans ? a.rows() : a.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns);
  if (result.size() > 0 && inner > 0)
    cblas_dgemm(CblasColMajor, left, right, size_of(rows), size_of(columns), size_of(inner), 1.0, a.data(),
                size_of(a.outerStride()), b.data(), size_of(b.outerStride()), 0.0, result.data(),
                size_of(rows));
  return result;
}

}  // namespace

std::optional<GeneralizedEigen> generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const lapack_int n = size_of(a.rows());
  GeneralizedEigen result{Eigen::VectorXd(n), a};
  Eigen::MatrixXd factor = b;
  if (n > 0 && LAPACKE_dsygvd(LAPACK_COL_MAJOR, 1, 'V', 'L', n, result.vectors.data(), n, factor.data(), n,
                              result.values.data()) != 0)
    return std::nullopt;
  return result;
}

Eigen::MatrixXd cholesky_solve(const Eigen::MatrixXd& b, const Eigen::MatrixXd& right) {
  const lapack_int n = size_of(b.rows());
  Eigen::MatrixXd factor = b, solution = right;
  if (solution.size() > 0)
    LAPACKE_dposv(LAPACK_COL_MAJOR, 'L', n, size_of(right.cols()), factor.data(), n, solution.data(), n);
  return solution;
}

Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b) {
  return multiply(a, CblasNoTrans, b, CblasNoTrans);
}

Eigen::MatrixXd transposed_product(const ConstMatrix& a, const ConstMatrix& b) {
  return multiply(a, CblasTrans, b, CblasNoTrans);
}

Eigen::MatrixXd product_transposed(const ConstMatrix& a, const ConstMatrix& b) {
  return multiply(a, CblasNoTrans, b, CblasTrans);
}

}  // namespace wavebalance::fem::detail
