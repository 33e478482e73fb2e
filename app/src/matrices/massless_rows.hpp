#pragma once

#include "matrices/structure_files.hpp"

namespace wavebalance::app {

/// The entries of `matrix` in these rows and columns, in their order. O(nonzeros).
Eigen::SparseMatrix<double> matrix_part(const Eigen::SparseMatrix<double>& matrix,
                                        const std::vector<int>& rows, const std::vector<int>& columns);

/// Eliminates rows without mass, such as rotations with lumped masses. They follow the others statically,
/// u_b = T u + K_bb^-1 f_b with T = -K_bb^-1 K_ba, which is no approximation if no damping of a file
/// resists such a motion, and none acts on rows that are loaded themselves: the matrices are transformed by
/// [I; T]. Leaves them where that does not hold, K_bb is not positive definite, structure.unsymmetric or
/// structure.free is set, or either part has more than 2000 rows. O(n^3).
void condense_massless_rows(StructureFiles& files);

/// Remedy for remaining rows without mass, as the end of a sentence; empty if there are none.
std::string advice_on_massless_rows(const Eigen::SparseMatrix<double>& mass);

}  // namespace wavebalance::app
