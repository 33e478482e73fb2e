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

}  // namespace wavebalance::solvers
