#pragma once
#include <functional>

#include "symmetric_factor.hpp"

namespace wavebalance::fem::detail {

/// Limits of a run of block_lanczos().
struct LanczosLimits {
  double tolerance = 1e-14;  ///< of the residual of a pair, relative to its eigenvalue
  int max_cycles = 1000;     ///< times that the basis is filled
  unsigned seed = 0;         ///< of the random start
  /// Called after each block with the number of pairs that have converged; the run ends if it returns false.
  std::function<bool(Eigen::Index)> go_on = [](Eigen::Index) { return true; };
};

/// Eigenpairs of A^-1 M, largest first, and whether all that were wanted have converged; those that have not
/// are left out.
struct LanczosResult {
  Eigen::VectorXd values;
  /// n x values, orthonormal in the inner product of M. It does not see rows without mass, which may hold
  /// rounding; one more application of A^-1 M removes that, as eigenmodes() applies it.
  Eigen::MatrixXd vectors;
  bool complete = false;
};

/// The `count` largest eigenpairs of A^-1 M, A given by its factor, M symmetric positive semidefinite, 1 <=
/// count < n, by Lanczos' iteration on blocks of two to eight vectors with full orthogonalisation in the
/// inner product of M [Golub & Underwood 1977; Grimes, Lewis & Simon 1994] and restarts from the best Ritz
/// vectors [Wu & Simon 2000]. A block needs one pass through factor and mass, single vectors need one each,
/// and finds multiple eigenvalues. Memory: n (2 count + 40) numbers. Throws std::domain_error if M is zero.
LanczosResult block_lanczos(const SymmetricFactor& factor, const Eigen::SparseMatrix<double>& mass,
                            Eigen::Index count, const LanczosLimits& limits);

}  // namespace wavebalance::fem::detail
