#include "matrices/structure_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "matrices/structure_files.hpp"
#include "matrices/symmetric_part.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/fem/static_displacements.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"
#include "wavebalance/solvers/structure/rigid_modes.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t most_rows_named = 4;  // of a contact that a mean of many nodes or modes moves

/// phi^T C phi / (2 omega), the ratio to critical damping as far as C does not couple the modes, and half the
/// loss factor.
Eigen::VectorXd damping_ratios_of(const Scene& scene, const StructureFiles& files,
                                  const fem::EigenmodesResult& modes) {
  const Structure& structure = scene.structure;
  const double hysteretic = 0.5 * structure.loss_factor;
  if (structure.stiffness_damping > 0.0)
    return (0.5 * structure.stiffness_damping * modes.omega).array() + hysteretic;
  Eigen::VectorXd ratios =
      Eigen::VectorXd::Constant(modes.omega.size(), structure.modal_damping + hysteretic);
  if (files.matrices.damping.size() == 0) return ratios;
  for (Eigen::Index mode = 0; mode < ratios.size(); ++mode) {
    const Eigen::VectorXd force = files.matrices.damping * modes.shapes.col(mode);
    ratios[mode] += modes.shapes.col(mode).dot(force) / (2.0 * modes.omega[mode]);
  }
  return ratios;
}

/// The scene with each of its pairs once.
Scene with_one_side(Scene scene) {
  for (ContactPair& pair : scene.contact.pairs) {
    pair.side = ObstacleSide::positive;
    if (reads_signal(pair.law)) pair.law = "linear";  // only places matter, and a signal has none
  }
  return scene;
}

/// The lowest modes; a semidefinite mass has fewer, because others differ from infinitely high ones only by
/// rounding.
fem::EigenmodesResult lowest_modes(const StructureFiles& files, const Eigen::SparseMatrix<double>& elastic,
                                   int count, const fem::EigenmodesOptions& options) {
  constexpr double highest = 1e6;  // ratio of frequencies, of whose square 1e-16 is 1e-4
  if (!files.reduced) return fem::eigenmodes(elastic, files.matrices.mass, count, options);
  for (;; --count) {
    try {
      fem::EigenmodesResult found = fem::eigenmodes(elastic, files.matrices.mass, count, options);
      if (count == 1 || found.omega.tail(1)[0] < highest * found.omega[0]) return found;
    } catch (const std::domain_error&) {
      if (count == 1) throw;
    }
  }
}

/// Their frequencies are zero, and a damping ratio has no meaning.
void leave_out_rigid_modes(fem::EigenmodesResult& modes, Eigen::Index rigid) {
  const Eigen::Index kept = std::max<Eigen::Index>(0, modes.omega.size() - rigid);
  modes.omega = modes.omega.tail(kept).eval();
  modes.frequencies_hz = modes.frequencies_hz.tail(kept).eval();
  modes.shapes = modes.shapes.rightCols(kept).eval();
}

/// The diagonal of S K^-1 S^T by an LU.
Eigen::VectorXd circulatory_compliances(const fem::Matrices& matrices,
                                        const solvers::ContactDirections& directions) {
  const Eigen::Index size = matrices.stiffness.rows();
  solvers::LinearStructure structure;
  structure.mass = matrices.mass;
  structure.damping.resize(size, size);
  structure.stiffness = matrices.stiffness;
  structure.load = Eigen::VectorXd::Zero(size);
  structure.contact_directions = directions;
  solvers::Condensation condensation(structure, solvers::CondensationMethod::sparse);
  return condensation.dynamic_compliance({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}).compliance.diagonal().real();
}

/// How many of `dofs` from one on are all rows of one name, as of an expanded beam; 1 for a single row.
std::size_t copies_from(const StructureFiles& files, const std::vector<int>& dofs, std::size_t from) {
  if (!files.dof_map) return 1;
  fem::NodeDof dof = files.dof_map->dof(dofs[from] - 1);
  const auto copies = std::size_t(files.dof_map->copies(dof));
  for (std::size_t i = 0; i < copies; ++i) {
    dof.copy = int(i) + 1;
    if (from + i >= dofs.size() || files.dof_map->row(dof) != dofs[from + i] - 1) return 1;
  }
  return copies;
}

/// "node 7 z", also of all of its rows.
std::string name_from(const StructureFiles& files, const std::vector<int>& dofs, std::size_t from) {
  const std::string name = files.row_name(dofs[from] - 1);
  return copies_from(files, dofs, from) > 1 ? name.substr(0, name.find(" #")) : name;
}

}  // namespace

std::vector<std::string> contact_names(const Scene& scene) {
  const auto files = structure_files(scene);
  std::vector<std::string> names;
  for (const SceneContact& contact : contact_places(scene)) {
    if (!contact.name.empty() || contact.dofs.empty()) {
      names.push_back(name_of(contact));
      continue;
    }
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < contact.dofs.size(); i += copies_from(*files, contact.dofs, i))
      rows.push_back(name_from(*files, contact.dofs, i));
    const bool negative = contact.coefficients.front() < 0.0 && (!contact.pair || contact.dofs.size() == 1);
    const std::size_t more = rows.size() > most_rows_named ? rows.size() - (most_rows_named - 1) : 0;
    rows.resize(rows.size() - more);
    names.push_back(fmt::format("{}{}{}", negative ? "-" : "", fmt::join(rows, ", "),
                                more > 0 ? fmt::format(" and {} more", more) : ""));
  }
  return names;
}

StructureFacts structure_facts(const Scene& scene, int modes) {
  const auto files = structure_files(scene);
  const fem::Matrices& matrices = files->matrices;
  const auto size = static_cast<int>(matrices.stiffness.rows());
  const Eigen::SparseMatrix<double> elastic = symmetric_part(matrices.stiffness);
  const bool free = scene.structure.matrices.free;
  fem::EigenmodesOptions options;
  options.shift = shift_of(free, elastic, matrices.mass);
  auto found = lowest_modes(*files, elastic, std::min(modes, size), options);
  StructureFacts facts;
  if (free) facts.rigid_motions = int(solvers::find_rigid_modes(matrices.mass, elastic).cols());
  leave_out_rigid_modes(found, facts.rigid_motions);
  facts.frequencies_hz = found.frequencies_hz;
  facts.damping_ratios = damping_ratios_of(scene, *files, found);
  const Scene one_sided = with_one_side(scene);
  const solvers::ContactDirections directions = contact_directions(one_sided, *files);
  const Eigen::MatrixXd loads = directions.transpose();
  facts.contacts = contact_names(one_sided);
  if (free) return facts;
  if (solvers::is_symmetric(matrices.stiffness)) {
    const Eigen::MatrixXd displacements = fem::static_displacements(matrices.stiffness, loads);
    facts.compliances = loads.cwiseProduct(displacements).colwise().sum().transpose();
  } else {
    facts.compliances = circulatory_compliances(matrices, directions);
  }
  return facts;
}

}  // namespace wavebalance::app
