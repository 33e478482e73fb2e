#pragma once
#include <complex>
// By default LAPACK's C interface uses types of C.
#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>

#include <Eigen/Core>

/// BLAS by its Fortran names: GSL has a slow library with the names of its C interface.
extern "C" {
void dgemm_(const char* left, const char* right, const lapack_int* rows, const lapack_int* columns,
            const lapack_int* inner, const double* alpha, const double* a, const lapack_int* lda,
            const double* b, const lapack_int* ldb, const double* beta, double* c, const lapack_int* ldc);
void zgemm_(const char* left, const char* right, const lapack_int* rows, const lapack_int* columns,
            const lapack_int* inner, const std::complex<double>* alpha, const std::complex<double>* a,
            const lapack_int* lda, const std::complex<double>* b, const lapack_int* ldb,
            const std::complex<double>* beta, std::complex<double>* c, const lapack_int* ldc);
void dtrsm_(const char* side, const char* triangle, const char* transpose, const char* diagonal,
            const lapack_int* rows, const lapack_int* columns, const double* alpha, const double* a,
            const lapack_int* lda, double* b, const lapack_int* ldb);
}

namespace wavebalance::solvers::detail {

inline lapack_int lapack_size(Eigen::Index size) { return static_cast<lapack_int>(size); }

}  // namespace wavebalance::solvers::detail
