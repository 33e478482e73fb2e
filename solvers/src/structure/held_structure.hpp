#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// A structure that is free to move along rigid_modes R, and the same one held at rest. Its static equation K
/// x = load - S^T f has a solution only where R^T (load - S^T f) = 0, and then a position along R is left
/// open. Springs kappa between contacts, K + kappa S^T Q Q^T S with the orthonormal basis Q of S R, make it
/// regular; their force -kappa Q Q^T S x is taken back from the contact forces.
struct HeldStructure {
  LinearStructure structure;  ///< without springs, and with empty rigid_modes
  /// n x n, for kappa = 1 N/m. Motions that no contact resists are held at as many degrees of freedom, whose
  /// springs carry nothing under a load that balances.
  Eigen::SparseMatrix<double> springs;
  Eigen::MatrixXd directions;  ///< Q, C x q: contact displacements of the motions that contacts resist
  Eigen::MatrixXd resisted;    ///< n x q, M-orthonormal: those motions
  Eigen::MatrixXd drifting;    ///< n x (r - q), M-orthonormal: the motions that no contact resists
  std::vector<Eigen::Index> drift_rows;  ///< r - q, the degrees of freedom at which these are held

  /// kappa, N/m, which affects only rounding: the largest entry of K, or of M omega^2 where that is larger,
  /// so that a static load moves the structure no further than a load of the frequency (Hz). The frequency
  /// is rounded to a power of 4, so that kappa changes seldom along a curve.
  double spring_stiffness(double frequency) const;
  LinearStructure with_springs(double stiffness) const;
};

/// The structure without the motions that no contact resists, in n - (r - q) new coordinates, without
/// loads: the contacts move alike. The same structure where there is no such motion, or where dampers
/// couple it to others. O(n^3).
LinearStructure without_drift(const LinearStructure& structure);

/// Holds a structure that has rigid_modes. O(n r^2 + C^2 q).
HeldStructure hold(const LinearStructure& structure);

}  // namespace wavebalance::solvers
