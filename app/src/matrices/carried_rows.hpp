#pragma once

#include "matrices/structure_files.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// S, n x moving rows, of a structure whose contacts touch rows that a base displacement moves; 0 x 0 where
/// none does. With the unknowns y of x = y + S x_b the displacement of a contact is its direction times y,
/// so laws and solvers need no motion of the base. S has the least norm. Throws StructureFault for a
/// contact between rows of the base only.
Eigen::MatrixXd carried_rows(const Scene& scene, const StructureFiles& files);

/// S times the base's displacement of a term, n values, for an amplitude of 1.
Eigen::VectorXd carried_by(const ForcingTerm& term, const Eigen::MatrixXd& carried,
                           const StructureFiles& files);

/// Refuses analyses that would need S: modal damping, loss factors, matrices that turn, and motions of the
/// whole structure. Throws StructureFault.
void check_carried(const Scene& scene, const StructureFiles& files);

}  // namespace wavebalance::app
