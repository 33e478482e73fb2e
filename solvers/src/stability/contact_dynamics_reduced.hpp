#pragma once
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// The structure projected on about `vectors` vectors of the block Krylov space of K^-1 M from K^-1 S^T,
/// which are orthonormal in K: stiffness I, and the compliance of the contacts is exact at zero frequency.
/// Without symmetry the space is built with K^-1 M and K^-1 C from K^-1 S^T and K^-T S^T, because modes of
/// a rotor couple planes that modes without C do not, and the vectors are orthonormal in K + K^T. Throws
/// std::invalid_argument where K, or then K + K^T, is not positive definite. One factorization of K, O(n
/// vectors^2).
LinearStructure krylov_reduction(const LinearStructure& structure, int vectors);

/// The structure without the degrees of freedom that have neither mass nor damping.
struct StaticCondensation {
  LinearStructure structure;
  Eigen::MatrixXd left_directions;  ///< C x n: S for the contact forces; `structure` has it for the
                                    ///< displacements
  Eigen::MatrixXd compliance;       ///< C x C, m/N: contribution of the removed ones to the compliance of the
                                    ///< contacts
};
/// Throws std::invalid_argument where they are not held by a stiffness. O(n^3).
StaticCondensation without_massless(const LinearStructure& structure);

}  // namespace wavebalance::solvers
