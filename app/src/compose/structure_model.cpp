#include "wavebalance/app/compose/structure_model.hpp"

#include "compose/compose_parts.hpp"
#include "matrices/boundary.hpp"
#include "matrices/carried_rows.hpp"
#include "matrices/load_places.hpp"
#include "matrices/loads.hpp"
#include "matrices/structure_files.hpp"
#include "matrices/symmetric_part.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/fem/bar.hpp"
#include "wavebalance/fem/centrifugal.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/solvers/structure/rigid_modes.hpp"

namespace wavebalance::app {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The tip's row of the consistent or lumped mass goes to its neighbour, where it acts as one rigid piece.
void move_tip_mass(Sparse& mass) {
  const Eigen::Index tip = mass.rows() - 1;
  const double moved = mass.coeff(tip, tip) + 2.0 * mass.coeff(tip, tip - 1);
  mass.coeffRef(tip - 1, tip - 1) += moved;
  for (const auto& [row, column] : {std::pair{tip, tip}, {tip, tip - 1}, {tip - 1, tip}})
    mass.coeffRef(row, column) = 0.0;
  mass.prune(0.0);
}

/// M r of a bar whose clamp moves along: of the first element's mass, which couples to the clamp, too.
Eigen::VectorXd bar_inertia(const Structure& bar, const Sparse& mass) {
  Eigen::VectorXd inertia = mass * Eigen::VectorXd::Ones(bar.elements);
  const double element = bar.density * bar.area * bar.length / bar.elements;
  inertia[0] += (1.0 - bar.lumped_mass_fraction) * element / 6.0;
  return inertia;
}

StructureModel bar_model(const Scene& scene) {
  const Structure& bar = scene.structure;
  fem::Matrices matrices = fem::bar({.youngs_modulus = bar.youngs_modulus,
                                     .density = bar.density,
                                     .area = bar.area,
                                     .length = bar.length,
                                     .elements = bar.elements,
                                     .stiffness_damping = bar.stiffness_damping,
                                     .lumped_fraction = bar.lumped_mass_fraction});
  const bool massless = bar.massless_tip || redistributes_mass(scene);
  if (massless && bar.elements < 2)
    throw std::invalid_argument("structure.elements is 1; a tip without mass needs 2 or more");
  if (massless) move_tip_mass(matrices.mass);
  StructureModel model;
  model.structure.mass = std::move(matrices.mass);
  model.structure.damping = std::move(matrices.damping);
  model.structure.stiffness = std::move(matrices.stiffness);
  model.structure.contact_directions = solvers::contact_rows({bar.elements - 1}, bar.elements);
  model.structure.load = Eigen::VectorXd::Zero(bar.elements);
  model.structure.load[bar.elements - 1] = plain_amplitude(scene.forcing);
  model.structure.forces =
      forces_of(scene.forcing, {.force = Eigen::VectorXd::Unit(bar.elements, bar.elements - 1),
                                .inertia = bar_inertia(bar, model.structure.mass)});
  model.unknowns = bar.elements;
  return model;
}

/// Sets the structure's matrices and loads; an absent damping matrix becomes zero.
void set_structure(StructureModel& model, fem::Matrices matrices, const Loads& loads) {
  const Eigen::Index size = loads.load.size();
  if (matrices.damping.size() == 0) matrices.damping = Sparse(size, size);
  model.structure.mass = std::move(matrices.mass);
  model.structure.damping = std::move(matrices.damping);
  model.structure.stiffness = std::move(matrices.stiffness);
  model.structure.load = loads.load;
  model.structure.forces = loads.forces;
}

/// Adds M Phi diag(2 ratio omega) Phi^T M with all modes Phi to the damping, which may be gyroscopic.
/// O(size^3).
void add_modal_damping(solvers::LinearStructure& structure, double ratio, bool free) {
  if (ratio == 0.0) return;
  fem::EigenmodesOptions options;
  options.shift = shift_of(free, structure.stiffness, structure.mass);
  const auto modes =
      fem::eigenmodes(symmetric_part(structure.stiffness), structure.mass, structure.size(), options);
  const Eigen::MatrixXd momenta = structure.mass * modes.shapes;
  const Eigen::MatrixXd damping = momenta * (2.0 * ratio * modes.omega).asDiagonal() * momenta.transpose();
  const Sparse symmetric = (0.5 * (damping + damping.transpose())).sparseView();
  structure.damping += symmetric;
}

/// Nodes of the tip that share the force; at mid chord the one or two nearest pairs.
std::vector<int> loaded_nodes(const fem::Blade& blade, TipPlace place) {
  const auto& nodes = blade.contact_nodes;  // in pairs from the leading edge on
  const auto pairs = static_cast<std::ptrdiff_t>(nodes.size() / 2);
  if (place == TipPlace::leading_edge) return {nodes.begin(), nodes.begin() + 2};
  if (place == TipPlace::trailing_edge) return {nodes.end() - 2, nodes.end()};
  return {nodes.begin() + 2 * ((pairs - 1) / 2), nodes.begin() + 2 * (pairs / 2 + 1)};
}

/// Where `place` and `direction` have the force, of size `amplitude`.
Eigen::VectorXd blade_load(const Scene& scene, const fem::Blade& blade, double amplitude) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(blade.model.dofs.count());
  const auto nodes = loaded_nodes(blade, scene.forcing.place);
  const int axis = static_cast<int>(scene.forcing.direction);
  for (const int node : nodes)
    load[blade.model.dofs.unknown(3 * node + axis)] = amplitude / static_cast<double>(nodes.size());
  return load;
}

/// M r of a blade whose root moves along `direction`, without the mass that couples to the root itself.
Eigen::VectorXd blade_inertia(const Scene& scene, const fem::Blade& blade, const Sparse& mass) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(mass.rows());
  const auto nodes = static_cast<int>(blade.model.mesh.nodes.cols());
  for (int node = 0; node < nodes; ++node)
    if (const int unknown = blade.model.dofs.unknown(3 * node + static_cast<int>(scene.forcing.direction));
        unknown >= 0)
      motion[unknown] = 1.0;
  return mass * motion;
}

/// The stiffness of the turning blade; its damping is the material's at rest.
void stiffen_by_rotation(fem::Matrices& matrices, const fem::SolidModel& solid, const BladeStructure& blade) {
  if (blade.rotation_speed == 0.0) return;
  const auto& axis = blade.rotation_axis;
  const auto stiffening = fem::centrifugal_stiffness(
      solid, matrices.stiffness,
      {.direction = {axis[0], axis[1], axis[2]}, .point = {0, 0, -blade.hub_radius}});
  matrices.stiffness = stiffening.stiffness(matrices.stiffness, blade.rotation_speed);
}

/// The radial unknown of each corner node of the tip and, with friction, that along its tangent.
std::vector<int> tip_unknowns(const Scene& scene, const fem::Blade& blade) {
  if (!has_friction(scene)) return blade.contact_unknowns;
  std::vector<int> unknowns;
  for (const int node : blade.contact_nodes)
    for (const Direction along : {Direction::z, scene.contact.tangent})
      unknowns.push_back(blade.model.dofs.unknown(3 * node + static_cast<int>(along)));
  return unknowns;
}

StructureModel blade_model(const Scene& scene, const solvers::Observer& observer) {
  StructureModel model;
  if (!solvers::goes_on(observer, {.phase = "assembling the structure"})) throw ReductionCancelled();
  const auto blade = std::make_shared<const fem::Blade>(fem::blade(blade_options(scene.structure)));
  fem::Matrices matrices = fem::solid_matrices(blade->model, scene.structure.stiffness_damping);
  stiffen_by_rotation(matrices, blade->model, scene.structure.blade);
  model.unknowns = blade->model.dofs.count();
  const Loads loads{blade_load(scene, *blade, plain_amplitude(scene.forcing)),
                    forces_of(scene.forcing, {.force = blade_load(scene, *blade, 1.0),
                                              .inertia = blade_inertia(scene, *blade, matrices.mass)})};
  reduce(model, matrices, loads, solvers::contact_rows(tip_unknowns(scene, *blade), model.unknowns),
         {blade->boundary_unknowns}, scene.structure.kept_modes, observer);
  model.blade = blade;
  return model;
}

/// beta K of the structure at rest, as the material damps.
Sparse proportional_damping(const StructureFiles& files, double beta) {
  if (files.spin_stiffness.size() == 0) return beta * files.matrices.stiffness;
  return beta * (files.matrices.stiffness - files.spin_speed * files.spin_speed * files.spin_stiffness);
}

StructureModel matrices_model(const Scene& scene, const solvers::Observer& observer) {
  const auto files = structure_files(scene);
  check_against_files(scene, *files);
  const Structure& structure = scene.structure;
  StructureModel model;
  model.warnings = warnings_of(scene, *files);
  model.unknowns = static_cast<int>(files->matrices.stiffness.rows());
  model.mesh = files->mesh;
  fem::Matrices matrices = files->matrices;
  if (structure.stiffness_damping > 0.0) {
    const Sparse proportional = proportional_damping(*files, structure.stiffness_damping);
    if (matrices.damping.size() == 0)
      matrices.damping = proportional;
    else  // gyroscopic forces
      matrices.damping += proportional;
  }
  const Eigen::VectorXd unit = unit_load(scene, *files);
  const Loads loads{plain_amplitude(scene.forcing) * unit,
                    forces_of(scene.forcing, {.force = unit,
                                              .inertia = {},
                                              .files = files.get(),
                                              .stiffness_damping = structure.stiffness_damping,
                                              .carried = carried_rows(scene, *files)})};
  const solvers::ContactDirections directions = contact_directions(scene, *files);
  const solvers::TurningParts turning{files->gyroscopic, files->spin_stiffness, files->spin_speed};
  if (structure.kept_modes < 0) {
    set_structure(model, std::move(matrices), loads);
    model.structure.contact_directions = directions;
    model.structure.turning = turning;
    model.plane = rotor_plane(scene, *files, directions);
    return model;
  }
  const std::vector<BoundaryCoordinate> boundary = boundary_coordinates(scene, *files);
  reduce(model, matrices, loads, directions, {unknowns_of(boundary), merging(boundary, model.unknowns)},
         structure.kept_modes, observer, turning);
  const Eigen::MatrixXd plane = rotor_plane(scene, *files, directions);
  if (plane.size() > 0) model.plane = plane * model.recovery;
  return model;
}

StructureModel model_of_type(const Scene& scene, const solvers::Observer& observer) {
  if (scene.structure.type == StructureType::bar) return bar_model(scene);
  return scene.structure.type == StructureType::blade ? blade_model(scene, observer)
                                                      : matrices_model(scene, observer);
}

/// The structure before the mass of its contacts is redistributed.
solvers::LinearStructure structure_with_mass(const Scene& scene, const StructureModel& model) {
  if (scene.structure.type != StructureType::bar) return model.structure;
  Scene kept = scene;
  kept.contact.mass = ContactMass::keep;
  return bar_model(kept).structure;
}

/// Modes in addition to massless contacts: kept by a reduction, or as many as the contacts leave.
int massless_modes(const Structure& structure, const solvers::LinearStructure& model) {
  const int most = model.size() - model.contacts();
  return structure.kept_modes > 0 ? std::min(structure.kept_modes, most) : most;
}

}  // namespace

Eigen::MatrixXd StructureModel::recover(const Eigen::MatrixXd& coordinates) const {
  if (coordinates.rows() != size())
    throw std::invalid_argument("StructureModel::recover: there are " + std::to_string(coordinates.rows()) +
                                " rows of coordinates; there must be " + std::to_string(size()));
  return reduced() ? Eigen::MatrixXd(recovery * coordinates) : coordinates.topRows(unknowns);
}

void set_gaps(StructureModel& model, const Scene& scene) {
  const int contacts = model.contacts();
  const std::vector<SceneContact> all = contacts_of(scene);
  if (std::ssize(all) != contacts)
    throw std::invalid_argument("the scene has " + std::to_string(all.size()) +
                                " contacts; there must be as many as the structure has, " +
                                std::to_string(contacts));
  model.gaps.resize(contacts);
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  for (int i = 0; i < contacts; ++i) {
    const SceneContact& contact = all[std::size_t(i)];
    model.gaps[i] = mode && !has_gap(contact.law) ? scene.analysis.reference_length : contact.gap;
  }
}

StructureModel make_model(const Scene& scene, const solvers::Observer& observer) {
  const WallClock clock;
  StructureModel model = model_of_type(scene, observer);
  const bool free = scene.structure.type == StructureType::matrices && scene.structure.matrices.free;
  add_modal_damping(model.structure, scene.structure.modal_damping, free);
  if (free)
    model.structure.rigid_modes = solvers::find_rigid_modes(model.structure.mass, model.structure.stiffness);
  model.structure.loss_factor = scene.structure.loss_factor;
  if (redistributes_mass(scene)) {
    const solvers::LinearStructure with_mass = structure_with_mass(scene, model);
    if (scene.structure.type != StructureType::bar)
      make_contacts_massless(model, massless_modes(scene.structure, model.structure));
    model.frequency_change = frequency_change(with_mass, model.structure);
  }
  append_signals(model, scene);
  model.turning = model.structure.turning;
  if (!turns_along_curve(scene)) model.structure.turning = {};
  set_gaps(model, scene);
  if (scene.structure.type != StructureType::bar) model.reduction_seconds = clock.seconds();
  return model;
}

int reduced_size(const Scene& scene) {
  const Structure& structure = scene.structure;
  if (structure.type == StructureType::bar) return structure.elements;
  if (structure.type == StructureType::blade) return 3 * tip_corners(structure.blade) + structure.kept_modes;
  const auto files = structure_files(scene);
  if (structure.kept_modes < 0) return static_cast<int>(files->matrices.stiffness.rows());
  return static_cast<int>(boundary_coordinates(scene, *files).size()) + structure.kept_modes;
}

std::int64_t structure_dofs(const Scene& scene) {
  const Structure& structure = scene.structure;
  if (structure.type == StructureType::bar) return structure.elements;
  if (structure.type == StructureType::blade) return blade_unknowns(structure.blade);
  return structure_files(scene)->matrices.stiffness.rows();
}

std::int64_t blade_unknowns(const BladeStructure& blade) {
  const std::int64_t x = blade.chord_elements, y = blade.thickness_elements, z = blade.span_elements;
  const std::int64_t corners = (x + 1) * (y + 1);
  if (blade.element == SolidElement::hexahedron8) return 3 * corners * z;
  const std::int64_t level = corners + x * (y + 1) + (x + 1) * y;  // with the edges' midpoints
  return 3 * (level + corners) * z;
}

fem::BladeOptions blade_options(const Structure& structure) {
  const BladeStructure& blade = structure.blade;
  fem::BladeOptions options;
  options.chord = blade.chord;
  options.thickness_ratio = blade.thickness_ratio;
  options.camber_ratio = blade.camber_ratio;
  options.angle_degrees = blade.angle_degrees;
  options.edge_thickness = blade.edge_thickness;
  options.length = structure.length;
  options.material = {structure.youngs_modulus, blade.poissons_ratio, structure.density};
  options.chord_elements = blade.chord_elements;
  options.thickness_elements = blade.thickness_elements;
  options.span_elements = blade.span_elements;
  options.element = blade.element;
  return options;
}

}  // namespace wavebalance::app
