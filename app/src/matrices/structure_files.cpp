#include "matrices/structure_files.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "files/contains.hpp"
#include "matrices/boundary.hpp"
#include "matrices/carried_rows.hpp"
#include "matrices/load_places.hpp"
#include "matrices/massless_rows.hpp"
#include "matrices/moved_mesh.hpp"
#include "matrices/structure_inputs.hpp"
#include "matrices/symmetric_part.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/fem/check_structure.hpp"
#include "wavebalance/fem/craig_bampton.hpp"
#include "wavebalance/fem/internal_nodes.hpp"

namespace wavebalance::app {
namespace {

constexpr std::string_view mass_key = "structure.mass";
constexpr std::string_view stiffness_key = "structure.stiffness";
constexpr std::string_view damping_key = "structure.damping";
constexpr std::string_view load_key = "forcing.load";

std::string_view key_of(fem::StructureMatrix matrix) {
  if (matrix == fem::StructureMatrix::mass) return mass_key;
  return matrix == fem::StructureMatrix::damping ? damping_key : stiffness_key;
}

/// Advice on a mass that is not definite.
std::string advice_on_mass(const fem::Matrices& matrices, bool reduced) {
  if (reduced || !fem::positive_semidefinite(matrices.mass)) return advice_on_massless_rows(matrices.mass);
  return ". It is semidefinite: some motions have no mass, as reduced integration leaves them (CalculiX: C3D20R, S8R, "
         "S4, B31). Expected structure.kept_modes beside it, whose modes have mass" +
         advice_on_massless_rows(matrices.mass);
}

/// Advice for a fault that a key of the scene would accept.
std::string advice_on(const fem::StructureFault& fault, const fem::Matrices& matrices,
                      const StructureFiles& files) {
  if (fault.matrix() == fem::StructureMatrix::mass) return advice_on_mass(matrices, files.reduced);
  if (!files.unsymmetric && fault.reason().find("is not symmetric") == 0)
    return ", or say structure.unsymmetric = true if it is meant";
  const bool stiffness = fault.matrix() == fem::StructureMatrix::stiffness;
  if (stiffness && !files.free && fault.reason().find("free to move") != std::string::npos)
    return " Say structure.free = true if it is meant";
  return "";
}

void check_matrices(const StructureFiles& files) {
  const fem::Matrices& matrices = files.matrices;
  try {
    fem::check_structure(matrices, {.allow_free = files.free,
                                    .unsymmetric = files.unsymmetric,
                                    .semidefinite_mass = files.reduced,
                                    .first_index = 1});
  } catch (const fem::StructureFault& fault) {
    throw StructureFault(key_of(fault.matrix()),
                         "the matrix " + fault.reason() + advice_on(fault, matrices, files));
  }
  if (!files.free) return;
  if (!solvers::is_symmetric(matrices.stiffness))
    throw StructureFault(stiffness_key,
                         "the matrix is not symmetric; expected a symmetric one with structure.free = true");
  if (!fem::positive_semidefinite(matrices.stiffness))
    throw StructureFault(stiffness_key, "the matrix is not positive semidefinite");
}

/// The rows that base displacements move, from 0, ascending.
std::vector<int> moving_rows(const Scene& scene) {
  std::vector<int> rows;
  for (const ForcingTerm& term : scene.forcing.terms)
    if (term.kind == LoadKind::base_displacement)
      for (const int dof : term.dofs) rows.push_back(std::abs(dof) - 1);
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

std::vector<std::string> term_paths(const Scene& scene) {
  std::vector<std::string> paths;
  for (const ForcingTerm& term : scene.forcing.terms) paths.push_back(term.load);
  return paths;
}

/// Removes the moving rows from a rotating part. Its coupling to them is in the coupling at one speed.
void hold_moving_rows(const StructureFiles& files, Eigen::SparseMatrix<double>& part, const char* key) {
  if (part.size() == 0 || files.moving.empty()) return;
  if (files.turns_along_curve && matrix_part(part, files.rows, files.base_rows).norm() > 0.0)
    throw StructureFault(
        key,
        "the matrix couples rows that a base displacement moves to others, and varies along the "
        "sweep; expected none of these entries, or structure.spin_speed > 0");
  part = matrix_part(part, files.rows, files.rows);
}

/// Takes the rows that a base moves, or that the stiffness marks as held, out of the unknowns.
void hold_rows(StructureFiles& files) {
  const Eigen::Index size = files.matrices.stiffness.rows();
  for (const int row : files.base_rows)
    if (row < 0 || row >= size)
      throw StructureFault(
          "forcing.terms",
          fmt::format("a base displacement moves degree of freedom {}; expected 1..{}", row + 1, size));
  const std::vector<int> held = fem::held_rows(files.matrices.stiffness);
  std::set_union(files.base_rows.begin(), files.base_rows.end(), held.begin(), held.end(),
                 std::back_inserter(files.moving));
  if (std::ssize(held) == size)
    throw StructureFault(stiffness_key, "the matrix has 1e36 in all rows, which holds them; expected fewer");
  if (std::ssize(files.moving) == size)
    throw StructureFault("forcing.terms", "a base displacement moves all degrees of freedom; expected fewer");
  for (int row = 0; row < size; ++row)
    if (!std::ranges::binary_search(files.moving, row)) files.rows.push_back(row);
  hold_moving_rows(files, files.gyroscopic, "structure.gyroscopic");
  hold_moving_rows(files, files.spin_stiffness, "structure.spin_stiffness");
  if (files.moving.empty()) return;
  for (const auto member : {&fem::Matrices::mass, &fem::Matrices::damping, &fem::Matrices::stiffness}) {
    Eigen::SparseMatrix<double>& matrix = files.matrices.*member;
    if (matrix.size() == 0) continue;
    files.coupling.*member = matrix_part(matrix, files.rows, files.moving);
    matrix = matrix_part(matrix, files.rows, files.rows);
  }
}

/// The files of the load, of the forcing and of each of its terms.
void read_loads(StructureFiles& files, const StructureInputs& inputs) {
  if (!files.paths[3].empty()) files.load = files.forces_at_unknowns(inputs.load(files.paths[3], load_key));
  for (std::size_t i = 0; i < files.term_paths.size(); ++i)
    files.term_loads.push_back(
        files.term_paths[i].empty()
            ? Eigen::VectorXd()
            : files.forces_at_unknowns(inputs.load(files.term_paths[i], term_section(i) + ".load")));
}

/// C + speed G and K + speed^2 K_s, as C and K.
void add_turning_parts(StructureFiles& files, const StructureInputs& inputs) {
  fem::Matrices& matrices = files.matrices;
  const Eigen::Index size = matrices.stiffness.rows();
  const auto part = [&](std::size_t path, const std::string& key, double sign, const char* kind) {
    Eigen::SparseMatrix<double> matrix = inputs.matrix(files.paths[path], key);
    const Eigen::SparseMatrix<double> other = matrix.transpose();
    if ((matrix - sign * other).norm() <= 1e-10 * matrix.norm()) return matrix;
    throw StructureFault(key, fmt::format("the matrix in {} is not {}; expected all of it, both triangles",
                                          files.paths[path], kind));
  };
  if (!files.paths[5].empty()) {
    if (matrices.damping.size() == 0) matrices.damping.resize(size, size);
    files.gyroscopic = part(5, "structure.gyroscopic", -1.0, "skew-symmetric");
    matrices.damping += files.spin_speed * files.gyroscopic;
  }
  if (files.paths[6].empty()) return;
  files.spin_stiffness = part(6, "structure.spin_stiffness", 1.0, "symmetric");
  matrices.stiffness += files.spin_speed * files.spin_speed * files.spin_stiffness;
}

/// Files named by a scene, none of which has been read.
StructureFiles named_files(const Scene& scene) {
  const MatricesStructure& structure = scene.structure.matrices;
  StructureFiles files;
  files.paths = {structure.mass,    structure.stiffness,  structure.damping,       scene.forcing.load,
                 structure.dof_map, structure.gyroscopic, structure.spin_stiffness};
  files.spin_speed = spin_speed(scene);
  files.turns_along_curve = turns_along_curve(scene);
  files.term_paths = term_paths(scene);
  files.mesh_path = structure.mesh;
  files.base_rows = moving_rows(scene);
  files.unsymmetric = structure.unsymmetric || !structure.gyroscopic.empty();
  files.free = structure.free;
  files.reduced = scene.structure.kept_modes >= 0;
  return files;
}

bool same_names(const StructureFiles& a, const StructureFiles& b) {
  return a.paths == b.paths && a.spin_speed == b.spin_speed && a.turns_along_curve == b.turns_along_curve &&
         a.term_paths == b.term_paths && a.mesh_path == b.mesh_path && a.base_rows == b.base_rows &&
         a.unsymmetric == b.unsymmetric && a.free == b.free && a.reduced == b.reduced;
}

StructureFiles read_files(StructureFiles files) {
  const auto& paths = files.paths;
  const StructureInputs inputs(paths[1], paths[4]);
  fem::Matrices& matrices = files.matrices;
  matrices.stiffness = inputs.stiffness();
  matrices.mass = inputs.matrix(paths[0], mass_key);
  if (!paths[2].empty()) matrices.damping = inputs.matrix(paths[2], damping_key);
  add_turning_parts(files, inputs);
  files.dof_map = inputs.map();
  if (files.dof_map) files.internal_from = fem::first_internal_node(matrices.stiffness, *files.dof_map);
  hold_rows(files);
  condense_massless_rows(files);
  check_matrices(files);
  files.damping_adds_energy = !fem::positive_semidefinite(symmetric_part(matrices.damping));
  read_loads(files, inputs);
  if (!files.mesh_path.empty()) files.mesh = moved_mesh(files.mesh_path, files);
  return files;
}

/// Rows in contact have not been condensed.
void check_touched(const std::vector<int>& dofs, const StructureFiles& files, std::string_view key) {
  for (const int dof : dofs)
    if (std::ranges::binary_search(files.massless, std::abs(dof) - 1))
      throw StructureFault(
          key, fmt::format("degree of freedom {} has no mass and is condensed; expected one with mass", dof));
}

/// The rows of the directions of a pair, by their keys.
std::array<std::pair<const char*, const std::vector<int>*>, 3> rows_of(const ContactPair& pair) {
  return {{{".dofs", &pair.dofs}, {".tangent", &pair.tangent}, {".second_tangent", &pair.second_tangent}}};
}

/// Rows of the pairs in 1..n, each with a coefficient.
void check_pairs(const std::vector<ContactPair>& pairs, Eigen::Index size) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const auto& [name, rows] : rows_of(pairs[i]))
      for (const int dof : *rows)
        if (dof < 1 || dof > size)
          throw StructureFault(pair_section(i) + name,
                               fmt::format("there is no degree of freedom {}; expected 1..{}", dof, size));
    if (pairs[i].coefficients.size() != pairs[i].dofs.size())
      throw StructureFault(pair_section(i) + ".coefficients",
                           fmt::format("there are {}; expected one for each of {} dofs",
                                       pairs[i].coefficients.size(), pairs[i].dofs.size()));
  }
}

/// Rows of contacts, from 0, of nodes with several rows of one name, of which contacts leave some out.
std::vector<int> corner_rows(const Scene& scene, const StructureFiles& files) {
  std::vector<int> touched, corners;
  for (const SceneContact& contact : contact_places(scene))
    for (const int dof : contact.dofs)
      if (!contains(touched, dof - 1)) touched.push_back(dof - 1);
  for (const int row : touched) {
    fem::NodeDof other = files.dof_map->dof(row);
    const int copies = files.dof_map->copies(other);
    for (other.copy = 1; other.copy <= copies; ++other.copy)
      if (!contains(touched, files.dof_map->row(other))) {
        corners.push_back(row);
        break;
      }
  }
  return corners;
}

}  // namespace

StructureFault::StructureFault(std::string_view key, const std::string& reason)
    : std::runtime_error(reason), key_(key) {}

std::string StructureFiles::row_name(int row) const {
  return dof_map ? dof_map->name(row) : "row " + std::to_string(row + 1);
}

Eigen::VectorXd StructureFiles::rows_along(int axis) const {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(file_rows());
  for (int row = 0; dof_map && row < dof_map->rows(); ++row)
    if (dof_map->dof(row).direction == axis + 1 &&
        !(internal_from && dof_map->dof(row).node >= *internal_from))
      along[row] = 1.0;
  return along;
}

Eigen::VectorXd StructureFiles::inertia(const Eigen::VectorXd& displacements) const {
  Eigen::VectorXd result = matrices.mass * at_unknowns(displacements);
  if (!moving.empty()) result += coupling.mass * displacements(moving);
  return result;
}

Eigen::VectorXd StructureFiles::forces_at_unknowns(const Eigen::VectorXd& forces) const {
  if (massless.empty()) return forces(rows);
  return forces(rows) + followers.transpose() * forces(massless);
}

std::vector<std::string> warnings_of(const Scene& scene, const StructureFiles& files) {
  std::vector<std::string> warnings;
  if (files.damping_adds_energy)
    warnings.emplace_back(
        "structure.damping is not positive semidefinite: it adds energy to some motion, so that the structure itself "
        "is unstable");
  const std::vector<int> corners = files.dof_map ? corner_rows(scene, files) : std::vector<int>();
  if (corners.empty()) return warnings;
  fem::NodeDof first = files.dof_map->dof(corners.front());
  warnings.push_back(fmt::format(
      "Contacts act at \"{}\"{} alone, a corner of the expanded beam or shell, where a force also twists it. "
      "\"{}\" without the number is the mean of the node's {} rows.",
      files.row_name(corners.front()),
      corners.size() == 1 ? "" : fmt::format(" and {} other such rows", corners.size() - 1), to_string(first),
      files.dof_map->copies(first)));
  return warnings;
}

std::shared_ptr<const StructureFiles> structure_files(const Scene& scene) {
  const auto& known = scene.structure.matrices.files.contents;
  StructureFiles wanted = named_files(scene);
  if (known && same_names(*known, wanted)) return known;
  return std::make_shared<const StructureFiles>(read_files(std::move(wanted)));
}

void check_against_files(const Scene& scene, const StructureFiles& files) {
  const Eigen::Index size = files.matrices.stiffness.rows(), all = files.file_rows();
  check_dofs(scene.structure.matrices.contact_dofs, all, "structure.contact_dofs");
  check_unknown(scene.structure.matrices.contact_dofs, files, "structure.contact_dofs");
  check_touched(scene.structure.matrices.contact_dofs, files, "structure.contact_dofs");
  check_pairs(scene.contact.pairs, all);
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i)
    for (const auto& [name, rows] : rows_of(scene.contact.pairs[i]))
      check_touched(*rows, files, pair_section(i) + name);
  check_loads(scene, files);
  check_carried(scene, files);
  if (scene.structure.kept_modes < 0) return;
  const Eigen::Index boundary = std::ssize(boundary_coordinates(scene, files));
  if (boundary >= size)
    throw StructureFault("structure.kept_modes",
                         "all degrees of freedom are in contact or loaded; expected "
                         "no reduction, that is no kept_modes");
  if (scene.structure.kept_modes > size - boundary)
    throw StructureFault("structure.kept_modes",
                         fmt::format("expected at most {}, of {} degrees of freedom those neither in contact "
                                     "nor loaded",
                                     size - boundary, size));
}

solvers::ContactDirections contact_directions(const Scene& scene, const StructureFiles& files) {
  std::vector<int> unknown(static_cast<std::size_t>(files.file_rows()), -1);  // of each row of the files
  for (std::size_t i = 0; i < files.rows.size(); ++i)
    unknown[std::size_t(files.rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  int contacts = 0;
  for (const SceneContact& contact : contact_places(scene)) {
    for (std::size_t i = 0; i < contact.dofs.size(); ++i)
      if (const int row = unknown[std::size_t(contact.dofs[i] - 1)]; row >= 0)
        entries.emplace_back(contacts, row, contact.coefficients[i]);
    ++contacts;
  }
  solvers::ContactDirections directions(contacts, std::ssize(files.rows));
  directions.setFromTriplets(entries.begin(), entries.end());
  directions.prune(0.0);
  return directions;
}

std::vector<int> boundary_rows(const Scene& scene, const StructureFiles& files) {
  std::vector<int> rows = fem::touched_unknowns(contact_directions(scene, files));
  for (const int row : loaded_rows(scene, files))
    if (!contains(rows, row)) rows.push_back(row);
  return rows;
}

}  // namespace wavebalance::app
