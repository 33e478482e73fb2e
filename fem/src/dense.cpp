#include "dense.hpp"

#include <complex>
// By default LAPACK's C interface uses types of C.
#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>

/// BLAS by its Fortran name: GSL has a slow library with the names of its C interface.
extern "C" void dgemm_(const char* left, const char* right, const lapack_int* rows, const lapack_int* columns,
                       const lapack_int* inner, const double* alpha, const double* a, const lapack_int* lda,
                       const double* b, const lapack_int* ldb, const double* beta, double* c,
                       const lapack_int* ldc);

namespace wavebalance::fem::detail {
namespace {

lapack_int size_of(Eigen::Index size) { return static_cast<lapack_int>(size); }

Eigen::MatrixXd multiply(const ConstMatrix& a, bool a_transposed, const ConstMatrix& b, bool b_transposed) {
  const lapack_int rows = size_of(a_transposed ? a.cols() : a.rows());
  const lapack_int columns = size_of(b_transposed ? b.rows() : b.cols());
  const lapack_int inner = size_of(a_transposed ? a.rows() : a.cols());
  const lapack_int a_stride = size_of(a.outerStride()), b_stride = size_of(b.outerStride());
  const double one = 1.0, zero = 0.0;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns);
  if (result.size() > 0 && inner > 0)
    dgemm_(a_transposed ? "T" : "N", b_transposed ? "T" : "N", &rows, &columns, &inner, &one, a.data(),
           &a_stride, b.data(), &b_stride, &zero, result.data(), &rows);
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

Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b) { return multiply(a, false, b, false); }

Eigen::MatrixXd transposed_product(const ConstMatrix& a, const ConstMatrix& b) {
  return multiply(a, true, b, false);
}

Eigen::MatrixXd product_transposed(const ConstMatrix& a, const ConstMatrix& b) {
  return multiply(a, false, b, true);
}

}  // namespace wavebalance::fem::detail
