#pragma once
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// The structure projected on about `vectors` vectors of the block Krylov space of K^-1 M from K^-1 S^T,
/// which are orthonormal in K: stiffness I, and the compliance of the contacts is exact at zero frequency.
/// Without symmetry the space is that of K^-1 M and K^-1 C from K^-1 S^T and K^-T S^T, since modes of a rotor
/// couple planes that those without C do not, and the vectors are orthonormal in K + K^T.
/// Throws std::invalid_argument where K, or then K + K^T, is not positive definite. One factorization of K,
/// O(n vectors^2).
LinearStructure krylov_reduction(const LinearStructure& structure, int vectors);

/// The structure without the degrees of freedom that have neither mass nor damping.
struct StaticCondensation {
  LinearStructure structure;
  Eigen::MatrixXd
      left_directions;         ///< C x n: S as the contact forces act on it; that of `structure` as they move
  Eigen::MatrixXd compliance;  ///< C x C, m/N: what the removed ones add to that of the contacts
};
/// Throws std::invalid_argument where they are not held by a stiffness. O(n^3).
StaticCondensation without_massless(const LinearStructure& structure);

}  // namespace wavebalance::solvers
