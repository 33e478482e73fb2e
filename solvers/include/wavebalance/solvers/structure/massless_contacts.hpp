#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// A structure with massless contacts, in reduced coordinates.
struct MasslessContacts {
  LinearStructure structure;
  Eigen::MatrixXd recovery;  ///< displacements of the given degrees of freedom from displacements of
                             ///< `structure`
};

/// The structure in its lowest modes and contacts without mass, which deflect relative to these modes by
/// the residual flexibility of the omitted ones [R. H. MacNeal, Comput. Struct. 1, 1971, 581-601; massless
/// boundaries: C. Monjaraz-Tec, J. Gross, M. Krack, J. Sound Vib. 526, 2022]: as rigid obstacles require.
/// The lowest `modes` frequencies without contact and the static deflections under contact forces equal the
/// structure's; the inertia of the omitted modes is neglected. Displacements of contacts become the last
/// degrees of freedom, one for obstacles on both sides. `modes` is at most the size less the number of
/// contacts; `omega` (rad/s) and `shapes` are all modes of the symmetric part of the stiffness, normalised
/// by the mass. Throws std::invalid_argument if modes < 1, or if the omitted modes do not move the contacts
/// independently of one another. O(n^3).
MasslessContacts with_massless_contacts(LinearStructure structure, int modes, const Eigen::VectorXd& omega,
                                        const Eigen::MatrixXd& shapes);

}  // namespace wavebalance::solvers
