#pragma once
#include "symmetric_factor.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem::detail {

/// eigenmodes() by the sparse iteration, with a given factor of stiffness - options.shift mass. All arguments
/// must be valid, compressed and symmetric, and the factor positive definite.
EigenmodesResult sparse_eigenmodes(const SymmetricFactor& factor,
                                   const Eigen::SparseMatrix<double>& stiffness,
                                   const Eigen::SparseMatrix<double>& mass, int count,
                                   const EigenmodesOptions& options);

}  // namespace wavebalance::fem::detail
