#pragma once

#include "matrices/structure_files.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Compares the loads of a scene with its files: rows, directions, and whether a force that is needed has a
/// place. Throws StructureFault.
void check_loads(const Scene& scene, const StructureFiles& files);

/// Rows counted from 1 with a sign are in 1..size, none twice; none of them moves with a base displacement or
/// is held. Throw StructureFault of `key`.
void check_dofs(const std::vector<int>& dofs, Eigen::Index size, std::string_view key);
void check_unknown(const std::vector<int>& dofs, const StructureFiles& files, std::string_view key);

/// The loads of amplitude 1 on at most most_loaded_dofs degrees of freedom, n x loads.
Eigen::MatrixXd boundary_loads(const Scene& scene, const StructureFiles& files);
/// Rows (from 0) of the loaded degrees of freedom, ascending. A load on more than most_loaded_dofs of them
/// is left out, and all loads if they have more together: they act through the modes of a reduction.
std::vector<int> loaded_rows(const Scene& scene, const StructureFiles& files);
inline constexpr int most_loaded_dofs = 30;

/// The force of amplitude 1 on all n degrees of freedom; zero where the scene gives it no place.
Eigen::VectorXd unit_load(const Scene& scene, const StructureFiles& files);

/// r of a base acceleration with an entry per row of the files: 1 along its direction, or 1 or -1 at its
/// dofs; of a base displacement at the rows that move.
Eigen::VectorXd base_direction(const ForcingTerm& term, const StructureFiles& files);
/// M r of a base acceleration, n values, kg: r is 1 along its direction, or 1 or -1 at its dofs.
Eigen::VectorXd inertia_of(const ForcingTerm& term, const StructureFiles& files);
/// M g of forcing.weight, n values, N; without one no values.
Eigen::VectorXd weight_of(const Forcing& forcing, const StructureFiles& files);
/// The force of a term of amplitude 1 on all n degrees of freedom; `elsewhere` if it has no place.
Eigen::VectorXd force_of(const Forcing& forcing, std::size_t term, const StructureFiles& files,
                         const Eigen::VectorXd& elsewhere);
/// 1 or -1, times its coefficient where there are some, as a force at each of `dofs`, from 1 with a sign,
/// which rows without mass pass on.
Eigen::VectorXd forces_at_dofs(const std::vector<int>& dofs, const StructureFiles& files,
                               const std::vector<double>& coefficients = {});

/// The plane in which a rotor turns, 2 x n: displacements along the two rows of the first unbalance that
/// has two, or else of the first ring; 0 x 0 without.
Eigen::MatrixXd rotor_plane(const Scene& scene, const StructureFiles& files,
                            const solvers::ContactDirections& directions);

}  // namespace wavebalance::app
