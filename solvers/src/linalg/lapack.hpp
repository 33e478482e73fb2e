#pragma once
#include <complex>
// The types of LAPACK's C interface are those of C unless they are given.
#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <cblas.h>
#include <lapacke.h>

#include <Eigen/Core>

namespace wavebalance::solvers::detail {

inline lapack_int lapack_size(Eigen::Index size) { return static_cast<lapack_int>(size); }

}  // namespace wavebalance::solvers::detail
