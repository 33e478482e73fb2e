#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace wavebalance::solvers {

/// The motions R of a structure that strain nothing, n x r with K R = 0 and R^T M R = 1: eigenvectors of K x
/// = mu M x with |mu| at most `tolerance` times the largest mu. No columns for a structure that is held. M
/// must be positive definite and K symmetric. O(n^3) up to 1000 degrees of freedom, beyond them one sparse
/// factorisation of K + s M and twenty solves with twelve vectors, so that at most eleven motions are found.
/// Throws std::invalid_argument for other matrices, and for one with a negative mu beyond the tolerance.
Eigen::MatrixXd find_rigid_modes(const Eigen::SparseMatrix<double>& mass,
                                 const Eigen::SparseMatrix<double>& stiffness, double tolerance = 1e-10);

}  // namespace wavebalance::solvers
