#pragma once

#include "matrices/structure_files.hpp"
#include "wavebalance/app/matrices/moved_mesh.hpp"

namespace wavebalance::app {

/// The mesh in a file, whose nodes move with the rows that the dof map gives them; nodes without rows do
/// not move. Rows of one name, as of shells that a code has expanded to solids, count with their mean.
/// Throws StructureFault without a map, and where none of its nodes is in the mesh.
std::shared_ptr<const MovedMesh> moved_mesh(const std::string& path, const StructureFiles& files);

}  // namespace wavebalance::app
