#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace wavebalance::solvers {

/// The linear part of a vibrating structure, M u'' + C u' + K u = load cos(2 pi f t) - sum_c e_c f_c(u_c),
/// with e_c the unit vector of contact degree of freedom c. SI units or any other consistent set.
struct LinearStructure {
  Eigen::SparseMatrix<double> mass;       ///< n x n, kg
  Eigen::SparseMatrix<double> damping;    ///< n x n, N s/m
  Eigen::SparseMatrix<double> stiffness;  ///< n x n, N/m
  Eigen::VectorXd load;                   ///< n, N, amplitude of the cosine load
  std::vector<int> contact_dofs = {0};    ///< at least one, distinct, each in 0..n-1; contacts in this order

  int size() const { return static_cast<int>(load.size()); }
  int contacts() const { return static_cast<int>(contact_dofs.size()); }
  /// Throws std::invalid_argument naming the member whose size does not fit, with both sizes, or the contact
  /// that is out of range or listed twice.
  void validate() const;
  /// The only contact. Throws std::invalid_argument naming `caller` when there are more.
  int single_contact(const char* caller) const;
};

}  // namespace wavebalance::solvers
