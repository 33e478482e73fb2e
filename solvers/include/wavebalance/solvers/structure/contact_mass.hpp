#pragma once
#include <vector>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// Whether the given contacts (rows of the structure's contact_directions) can stop at once, as rigid
/// obstacles make them: no combination of their directions moves only masses, except combinations that
/// cancel, as for obstacles on both sides. With N the degrees of freedom without mass, S N and S then have
/// the same rank. N is made of rows without mass and, where these do not suffice, of the null vectors of a
/// mass matrix of up to 400 rows. O(entries of S) where the rows suffice, else O(n^3).
bool contacts_are_massless(const LinearStructure& structure, const std::vector<int>& contacts);

/// The static compliance (m/N) of each contact direction with all masses held: the deflection under a unit
/// force of degrees of freedom with zero rows in the mass matrix, 0 if the direction has none. It is the
/// limit of the compliance at high frequencies unless only damping acts there. O(k^3), k their number.
Eigen::VectorXd compliance_beside_masses(const LinearStructure& structure);

}  // namespace wavebalance::solvers
