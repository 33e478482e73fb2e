#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace wavebalance::fem {

/// The static displacements K^-1 f under each column of `loads`, n x m. Throws std::invalid_argument if sizes
/// do not fit or the stiffness is not symmetric, std::domain_error if it is not positive definite. One sparse
/// factorisation.
Eigen::MatrixXd static_displacements(const Eigen::SparseMatrix<double>& stiffness,
                                     const Eigen::MatrixXd& loads);

}  // namespace wavebalance::fem
