#pragma once
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// A structure that is free to move along rigid_modes R, and the same one held at rest. Its static equation K
/// x = load - S^T f has a solution only where R^T (load - S^T f) = 0, and then a position along R is left
/// open. Springs kappa between contacts, K + kappa S^T Q Q^T S with the orthonormal basis Q of S R, make it
/// regular; their force -kappa Q Q^T S x is taken back from the contact forces.
struct HeldStructure {
  /// Empty rigid_modes. Motions that no contact resists are held at as many degrees of freedom, whose
  /// springs carry nothing under a load that balances.
  LinearStructure structure;
  Eigen::MatrixXd directions;  ///< Q, C x q: contact displacements of the motions that contacts resist
  double stiffness = 0.0;      ///< kappa, N/m
  Eigen::MatrixXd drifting;    ///< n x (r - q), M-orthonormal: the motions that no contact resists
};

/// Holds a structure that has rigid_modes. O(n r^2 + C^2 q).
HeldStructure hold(const LinearStructure& structure);

}  // namespace wavebalance::solvers
