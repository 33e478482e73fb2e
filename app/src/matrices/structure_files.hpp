#pragma once

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/fem/dof_map.hpp"
#include "wavebalance/fem/matrices.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::app {

struct MovedMesh;

/// The files of a structure of matrices, read and checked.
struct StructureFiles {
  /// Files of mass, stiffness, damping, load, dof map, G and K_s; empty: none.
  std::array<std::string, 7> paths;
  double spin_speed = 0.0;                     ///< rad/s
  bool turns_along_curve = false;              ///< as of the scene
  Eigen::SparseMatrix<double> gyroscopic;      ///< G, n x n, or 0 x 0; the damping has it at spin_speed
  Eigen::SparseMatrix<double> spin_stiffness;  ///< K_s likewise, of the stiffness
  std::vector<int> base_rows;  ///< rows of the files, from 0, that a base displacement moves, ascending
  std::vector<int> moving;     ///< these and the rows that the stiffness marks as held, ascending
  std::vector<int> massless;   ///< rows of the files, from 0, without mass, which are condensed
  Eigen::MatrixXd followers;   ///< massless x n: their displacements from the unknowns
  std::vector<int> rows;       ///< n, the other rows of the files: the unknowns
  fem::Matrices matrices;      ///< n x n; damping 0 x 0 if there is no file of it
  fem::Matrices coupling;      ///< n x moving, the parts of M, C and K between unknowns and moving rows
  Eigen::VectorXd load;        ///< n, or 0 if there is no file of it
  std::vector<std::string> term_paths;      ///< of each term of the forcing, its file of a load; empty: none
  std::vector<Eigen::VectorXd> term_loads;  ///< likewise, n each, or 0
  std::optional<fem::DofMap> dof_map;
  std::string mesh_path;                  ///< file of the mesh; empty: none
  std::shared_ptr<const MovedMesh> mesh;  ///< null without
  std::optional<int> internal_from;       ///< fem::first_internal_node()
  bool damping_adds_energy = false;       ///< it is not positive semidefinite
  bool unsymmetric = false;               ///< damping and stiffness were allowed to be
  bool free = false;                      ///< the stiffness was allowed to be singular
  bool reduced = false;                   ///< the mass was allowed to be semidefinite, for kept modes

  /// The file that names the rows.
  const std::string& map_path() const { return paths[4].empty() ? paths[1] : paths[4]; }
  /// "node 7 z" for a row from 0, or "row 20" without a dof map.
  std::string row_name(int row) const;
  Eigen::Index file_rows() const { return std::ssize(rows) + std::ssize(moving) + std::ssize(massless); }
  /// 1 at each row of the files that the dof map has along x, y or z (0, 1, 2), but of internal nodes; zero
  /// without a map.
  Eigen::VectorXd rows_along(int axis) const;
  /// M r, n values, kg, of displacements with an entry per row of the files.
  Eigen::VectorXd inertia(const Eigen::VectorXd& displacements) const;
  /// The displacements of the unknowns among those with an entry per row of the files.
  Eigen::VectorXd at_unknowns(const Eigen::VectorXd& values) const { return values(rows); }
  /// The forces on the unknowns among those with an entry per row of the files; massless rows pass theirs on.
  Eigen::VectorXd forces_at_unknowns(const Eigen::VectorXd& forces) const;
};

/// Warnings about a structure that can be solved, and the places of its contacts, a sentence each.
std::vector<std::string> warnings_of(const Scene& scene, const StructureFiles& files);

/// A key of a structure of matrices that does not fit its files, and why.
class StructureFault : public std::runtime_error {
 public:
  StructureFault(std::string_view key, const std::string& reason);
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// Those that load_scene() has read if the scene still names them, otherwise read and checked now: sizes,
/// symmetry, definiteness. Throws StructureFault. Two sparse factorisations.
std::shared_ptr<const StructureFiles> structure_files(const Scene& scene);

/// Holds the lists and numbers of a scene to the size n of its matrices: contact_dofs, pairs, load_dofs,
/// kept_modes, and whether a force that is needed has a place. Throws StructureFault.
void check_against_files(const Scene& scene, const StructureFiles& files);

/// The directions of contact among n degrees of freedom, contacts x n: of contact_dofs or of the pairs.
solvers::ContactDirections contact_directions(const Scene& scene, const StructureFiles& files);

/// The unknowns that contacts touch, then those loaded.
std::vector<int> boundary_rows(const Scene& scene, const StructureFiles& files);

}  // namespace wavebalance::app
