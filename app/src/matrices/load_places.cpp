#include "matrices/load_places.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "files/contains.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// Whether rows of the map move along the direction of a term or of the weight.
void check_direction(const StructureFiles& files, int axis, const std::string& key) {
  if (!files.dof_map)
    throw StructureFault(
        key,
        "expected structure.dof_map too, which names the rows along x, y and z, or dofs or a load instead");
  if (!files.rows_along(axis).isZero(0.0)) return;
  throw StructureFault(key, fmt::format("no row of {} moves along {}; expected another direction, or rows",
                                        files.map_path(), "xyz"[axis]));
}

void check_weight(const Scene& scene, const StructureFiles& files) {
  const std::vector<double>& weight = scene.forcing.weight;
  if (weight.empty()) return;
  if (scene.analysis.type == AnalysisType::nonlinear_mode && !names_friction(scene.contact))
    throw StructureFault(
        "forcing.weight",
        "does not belong to a nonlinear mode, a motion without any load, unless friction makes it "
        "begin at rest under static ones");
  for (int axis = 0; axis < 3; ++axis)
    if (weight[std::size_t(axis)] != 0.0) check_direction(files, axis, "forcing.weight");
}

bool is_in(const std::vector<int>& rows, int dof) {
  return std::ranges::binary_search(rows, std::abs(dof) - 1);
}

void check_not_driven(const std::vector<int>& dofs, const StructureFiles& files, std::string_view key) {
  for (const int dof : dofs)
    if (is_in(files.base_rows, dof))
      throw StructureFault(
          key, fmt::format("degree of freedom {} moves with a base displacement; expected one that does not",
                           dof));
}

void check_coefficients(const std::vector<double>& coefficients, const std::vector<int>& dofs,
                        const std::string& key, const std::string& dofs_name) {
  if (!coefficients.empty() && coefficients.size() != dofs.size())
    throw StructureFault(key, fmt::format("there are {}; expected one for each of {} {}", coefficients.size(),
                                          dofs.size(), dofs_name));
}

void check_terms(const Scene& scene, const StructureFiles& files) {
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i) {
    const ForcingTerm& term = scene.forcing.terms[i];
    const std::string key = term_section(i) + ".dofs";
    check_dofs(term.dofs, files.file_rows(), key);
    const std::string coefficients = term_section(i) + ".coefficients";
    check_coefficients(term.coefficients, term.dofs, coefficients, "dofs");
    if (!term.coefficients.empty() && term.kind != LoadKind::force)
      throw StructureFault(coefficients, "only with kind = \"force\"");
    if (term.kind == LoadKind::base_acceleration)
      check_not_driven(term.dofs, files, key);  // rows that are held move with the base
    else if (term.kind != LoadKind::base_displacement)
      check_unknown(term.dofs, files, key);
    if (!term.direction.empty())
      check_direction(files, term.direction.back() - 'x', term_section(i) + ".direction");
    const bool placed = files.load.size() > 0 || !scene.forcing.load_dofs.empty();
    if (term.kind == LoadKind::force && term.dofs.empty() && term.load.empty() && !placed)
      throw StructureFault(
          key,
          "missing; expected a list of integers, or a load of the term, or load or load_dofs in [forcing]");
  }
}

/// Terms and a weight with places replace a load of amplitude 0.
bool needs_place(const Scene& scene) {
  return kind_of(scene.analysis.type).under_load &&
         (scene.forcing.amplitude != 0.0 || (scene.forcing.terms.empty() && scene.forcing.weight.empty()));
}

void check_place(const Scene& scene) {
  const bool file = !scene.forcing.load.empty(), list = !scene.forcing.load_dofs.empty();
  if (file && list) throw StructureFault("forcing.load_dofs", "expected either load_dofs or load, not both");
  if (!file && !list && needs_place(scene))
    throw StructureFault(
        "forcing.load",
        "missing; expected load (a file of one column) or load_dofs (a list) for the place of the force");
}

/// For each of `dofs` an entry per row of the files: 1 or -1, times its coefficient where there are some.
Eigen::VectorXd signs_in_files(const std::vector<int>& dofs, const std::vector<double>& coefficients,
                               const StructureFiles& files) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(files.file_rows());
  for (std::size_t i = 0; i < dofs.size(); ++i)
    values[std::abs(dofs[i]) - 1] =
        (dofs[i] > 0 ? 1.0 : -1.0) * (coefficients.empty() ? 1.0 : coefficients[i]);
  return values;
}

}  // namespace

void check_loads(const Scene& scene, const StructureFiles& files) {
  check_dofs(scene.forcing.load_dofs, files.file_rows(), "forcing.load_dofs");
  check_coefficients(scene.forcing.load_coefficients, scene.forcing.load_dofs, "forcing.load_coefficients",
                     "load_dofs");
  check_unknown(scene.forcing.load_dofs, files, "forcing.load_dofs");
  check_terms(scene, files);
  check_weight(scene, files);
  check_place(scene);
}

void check_dofs(const std::vector<int>& dofs, Eigen::Index size, std::string_view key) {
  std::vector<int> rows;
  for (const int dof : dofs) {
    const int row = std::abs(dof);
    if (row < 1 || row > size)
      throw StructureFault(
          key,
          fmt::format("there is no degree of freedom {}; expected 1..{}, or one of them with a minus sign",
                      dof, size));
    if (contains(rows, row)) {
      const bool both = contains(dofs, -dof);
      throw StructureFault(
          key,
          fmt::format("degree of freedom {} is there twice; expected each once{}", row,
                      both ? fmt::format("; [[contact.pairs]] with dofs = [{}] and side = \"both\" has an "
                                         "obstacle on either side",
                                         row)
                           : ""));
    }
    rows.push_back(row);
  }
}

void check_unknown(const std::vector<int>& dofs, const StructureFiles& files, std::string_view key) {
  check_not_driven(dofs, files, key);
  for (const int dof : dofs)
    if (is_in(files.moving, dof))
      throw StructureFault(key,
                           fmt::format("degree of freedom {} is held: structure.stiffness has 1e36 on its "
                                       "diagonal there; expected one that is free",
                                       dof));
}

Eigen::VectorXd unit_load(const Scene& scene, const StructureFiles& files) {
  if (files.load.size() > 0) return files.load;
  return forces_at_dofs(scene.forcing.load_dofs, files, scene.forcing.load_coefficients);
}

Eigen::VectorXd base_direction(const ForcingTerm& term, const StructureFiles& files) {
  if (term.direction.empty()) return signs_in_files(term.dofs, {}, files);
  const double sign = term.direction.front() == '-' ? -1.0 : 1.0;
  return sign * files.rows_along(term.direction.back() - 'x');
}

Eigen::VectorXd inertia_of(const ForcingTerm& term, const StructureFiles& files) {
  return files.inertia(base_direction(term, files));
}

Eigen::VectorXd weight_of(const Forcing& forcing, const StructureFiles& files) {
  if (forcing.weight.empty()) return {};
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(files.file_rows());
  for (int axis = 0; axis < 3; ++axis)
    acceleration += forcing.weight[std::size_t(axis)] * files.rows_along(axis);
  return files.inertia(acceleration);
}

Eigen::VectorXd force_of(const Forcing& forcing, std::size_t term, const StructureFiles& files,
                         const Eigen::VectorXd& elsewhere) {
  const ForcingTerm& one = forcing.terms[term];
  if (!one.load.empty()) return files.term_loads[term];
  return one.dofs.empty() ? elsewhere : forces_at_dofs(one.dofs, files, one.coefficients);
}

Eigen::VectorXd forces_at_dofs(const std::vector<int>& dofs, const StructureFiles& files,
                               const std::vector<double>& coefficients) {
  return files.forces_at_unknowns(signs_in_files(dofs, coefficients, files));
}

Eigen::MatrixXd boundary_loads(const Scene& scene, const StructureFiles& files) {
  const Eigen::VectorXd unit = unit_load(scene, files);
  std::vector<Eigen::VectorXd> loads;
  const auto add = [&](const Eigen::VectorXd& load) {
    if ((load.array() != 0.0).count() <= most_loaded_dofs) loads.push_back(load);
  };
  add(unit);
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i)
    if (scene.forcing.terms[i].kind == LoadKind::force || scene.forcing.terms[i].kind == LoadKind::unbalance)
      add(force_of(scene.forcing, i, files, unit));
  Eigen::MatrixXd all(unit.size(), std::ssize(loads));
  for (std::size_t i = 0; i < loads.size(); ++i) all.col(Eigen::Index(i)) = loads[i];
  return all;
}

std::vector<int> loaded_rows(const Scene& scene, const StructureFiles& files) {
  const Eigen::VectorXd loads = boundary_loads(scene, files).cwiseAbs().rowwise().sum();
  std::vector<int> rows;
  for (Eigen::Index row = 0; row < loads.size(); ++row)
    if (loads[row] != 0.0) rows.push_back(static_cast<int>(row));
  if (rows.size() > most_loaded_dofs) rows.clear();
  return rows;
}

Eigen::MatrixXd rotor_plane(const Scene& scene, const StructureFiles& files,
                            const solvers::ContactDirections& directions) {
  for (const ForcingTerm& term : scene.forcing.terms) {
    if (term.kind != LoadKind::unbalance || term.dofs.size() != 2) continue;
    Eigen::MatrixXd plane(2, directions.cols());
    plane.row(0) = forces_at_dofs({term.dofs[0]}, files);
    plane.row(1) = forces_at_dofs({term.dofs[1]}, files);
    return plane;
  }
  const std::vector<SceneContact> contacts = contact_places(scene);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (acts_in_plane(contacts[i].law)) return Eigen::MatrixXd(directions.middleRows(Eigen::Index(i), 2));
  return {};
}

}  // namespace wavebalance::app
