#pragma once
#include "symmetric_factor.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem::detail {

/// eigenmodes() by the sparse iteration with a factor of stiffness - options.shift mass that exists already.
/// All arguments are valid, compressed and symmetric, the factor is positive definite.
EigenmodesResult sparse_eigenmodes(const SymmetricFactor& factor,
                                   const Eigen::SparseMatrix<double>& stiffness,
                                   const Eigen::SparseMatrix<double>& mass, int count,
                                   const EigenmodesOptions& options);

/// Throws std::invalid_argument, prefixed by the caller's name, if the matrix is not symmetric or an entry is
/// not finite.
void require_symmetric(const Eigen::SparseMatrix<double>& matrix, const char* caller, const char* name);

}  // namespace wavebalance::fem::detail
