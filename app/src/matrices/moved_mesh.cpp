#include "matrices/moved_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wavebalance::app {
namespace {

constexpr const char* mesh_key = "structure.mesh";
using Entries = std::vector<Eigen::Triplet<double>>;

/// How each row of the files follows from the unknowns.
class RowMotion {
 public:
  explicit RowMotion(const StructureFiles& files) : files_(files), unknown_(files.file_rows(), -1) {
    for (std::size_t i = 0; i < files.rows.size(); ++i) unknown_[std::size_t(files.rows[i])] = int(i);
  }

  void add(Entries& entries, Eigen::Index row, int file_row, double share) const {
    const int unknown = unknown_[static_cast<std::size_t>(file_row)];
    if (unknown >= 0) {
      entries.emplace_back(row, unknown, share);
      return;
    }
    const auto massless = std::lower_bound(files_.massless.begin(), files_.massless.end(), file_row);
    if (massless == files_.massless.end() || *massless != file_row) return;  // held
    const auto follower = files_.followers.row(massless - files_.massless.begin());
    for (Eigen::Index i = 0; i < follower.size(); ++i)
      if (follower[i] != 0.0) entries.emplace_back(row, i, share * follower[i]);
  }

 private:
  const StructureFiles& files_;
  std::vector<int> unknown_;  // of each row of the files; -1: none
};

}  // namespace

std::shared_ptr<const MovedMesh> moved_mesh(const std::string& path, const StructureFiles& files) {
  if (!files.dof_map)
    throw StructureFault(
        mesh_key,
        "there is no structure.dof_map; expected this file, which assigns rows to the nodes of the mesh");
  if (!files.base_rows.empty())
    throw StructureFault(mesh_key,
                         "a base_displacement moves rows of the matrices, whose nodes are not drawn; "
                         "expected no mesh, or a base_acceleration");
  fem::NumberedMesh found;
  try {
    found = fem::read_mesh(path);
  } catch (const fem::MatrixFileError& error) {
    throw StructureFault(mesh_key, error.what());
  }
  Entries entries;
  const RowMotion motion(files);
  for (std::size_t point = 0; point < found.nodes.size(); ++point)
    for (int direction = 1; direction <= 3; ++direction) {
      const int copies = files.dof_map->copies({found.nodes[point], direction});
      for (int copy = 1; copy <= copies; ++copy)
        motion.add(entries, 3 * static_cast<Eigen::Index>(point) + direction - 1,
                   files.dof_map->row({found.nodes[point], direction, copy}), 1.0 / copies);
    }
  if (entries.empty())
    throw StructureFault(mesh_key,
                         fmt::format("{} has none of the nodes of structure.dof_map; expected the mesh "
                                     "that the matrices were made of",
                                     path));
  auto moved = std::make_shared<MovedMesh>();
  moved->mesh = std::move(found.mesh);
  moved->displacements.resize(3 * moved->mesh.points.cols(), files.matrices.stiffness.rows());
  moved->displacements.setFromTriplets(entries.begin(), entries.end());
  return moved;
}

}  // namespace wavebalance::app
