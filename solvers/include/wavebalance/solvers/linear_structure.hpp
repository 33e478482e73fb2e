#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace wavebalance::solvers {

/// The linear part of a vibrating structure, M u'' + C u' + K u = load cos(2 pi f t) - e f_c(u_c), with one
/// contact degree of freedom c and e its unit vector. SI units or any other consistent set.
struct LinearStructure {
  Eigen::SparseMatrix<double> mass;       ///< n x n, kg
  Eigen::SparseMatrix<double> damping;    ///< n x n, N s/m
  Eigen::SparseMatrix<double> stiffness;  ///< n x n, N/m
  Eigen::VectorXd load;                   ///< n, N, amplitude of the cosine load
  int contact_dof = 0;                    ///< 0 <= contact_dof < n

  int size() const { return static_cast<int>(load.size()); }
  /// Throws std::invalid_argument naming the member whose size does not fit, with both sizes.
  void validate() const;
};

}  // namespace wavebalance::solvers
