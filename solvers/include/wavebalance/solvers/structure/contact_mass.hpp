#pragma once
#include <vector>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// Whether the given contacts (rows of the structure's contact_directions) can stop at once, as rigid
/// obstacles make them: no combination of their directions moves mass alone, but for those that cancel, as
/// obstacles on both sides do. With N the degrees of freedom without mass, the rank of S N is then that of S.
/// N is made of rows without mass and, where these do not suffice, of the null vectors of a mass matrix of up
/// to 400 rows. O(entries of S) where the rows suffice, else O(n^3).
bool contacts_are_massless(const LinearStructure& structure, const std::vector<int>& contacts);

/// The static compliance (m/N) of each contact direction with all masses held: what degrees of freedom whose
/// row in the mass matrix is zero give way under a unit force, 0 where the direction has none. It is the
/// limit of the compliance at high frequencies of a structure whose damping does not act there alone. O(k^3),
/// k their number.
Eigen::VectorXd compliance_beside_masses(const LinearStructure& structure);

}  // namespace wavebalance::solvers
