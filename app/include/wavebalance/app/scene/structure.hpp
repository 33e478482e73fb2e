#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::app {

using fem::SolidElement;

/// Kinds of structure, structure.type.
enum class StructureType { bar, blade, matrices };
/// Global direction of a blade's load.
enum class Direction { x, y, z };

/// Contents of the files that a scene names; see structure_files.hpp.
struct StructureFiles;

/// Files named by a scene as load_scene() has read and checked them, so that nothing is read twice. It does
/// not count when scenes are compared, because the paths of the files identify them.
struct ReadFiles {
  std::shared_ptr<const StructureFiles> contents = {};

  bool operator==(const ReadFiles&) const { return true; }
};

/// A structure from any finite element code. Paths are absolute once loaded, in a file relative to it.
struct MatricesStructure {
  std::string mass = {};               ///< file of a matrix [fem::read_matrix], n x n, kg
  std::string stiffness = {};          ///< likewise, N/m
  std::string damping = {};            ///< likewise, N s/m; or empty
  std::string dof_map = {};            ///< file that names the n rows by nodes [fem::read_dof_map]; or empty
  std::string mesh = {};               ///< file of the nodes and elements [fem::read_mesh]; or empty
  bool unsymmetric = false;            ///< damping and stiffness may be unsymmetric
  std::string gyroscopic = {};         ///< file of G, skew-symmetric: C + spin_speed G; or empty
  std::string spin_stiffness = {};     ///< file of K_s, symmetric: K + spin_speed^2 K_s; or empty
  double spin_speed = 0.0;             ///< rad/s; 0: 2 pi Forcing::frequency, with the load
  bool free = false;                   ///< the structure is free to move
  std::vector<int> contact_dofs = {};  ///< from 1; -i: dof i with its obstacle on the negative side
  ReadFiles files = {};

  bool operator==(const MatricesStructure&) const = default;
};

/// A cambered, tapered, twisted blade, clamped at z = 0 [fem::BladeOptions]; its material and length are in
/// Structure. Pairs hold the values at root and tip. Its tip's corner nodes may touch an obstacle radially.
struct BladeStructure {
  std::array<double, 2> chord = {0.052, 0.056};           ///< m, > 0
  std::array<double, 2> thickness_ratio = {0.09, 0.031};  ///< over the chord, > 0
  std::array<double, 2> camber_ratio = {0.098, 0.011};    ///< over the chord
  std::array<double, 2> angle_degrees = {10.0, 35.0};
  double edge_thickness = 0.35;  ///< over that at mid chord, in (0, 1]
  double poissons_ratio = 0.31;
  SolidElement element = SolidElement::hexahedron20;
  int chord_elements = 11;
  int thickness_elements = 1;
  int span_elements = 16;
  double rotation_speed = 0.0;  ///< rad/s, >= 0
  double hub_radius = 0.2;      ///< m, >= 0: the axis passes through z = -hub_radius
  std::array<double, 3> rotation_axis = {1.0, 0.0, 0.0};  ///< direction of the axis

  bool operator==(const BladeStructure&) const = default;
};

/// The vibrating structure: an axial bar, clamped at x = 0, whose tip x = length may touch an obstacle [JL14,
/// Fig. 1]; a blade; or any structure as matrices.
struct Structure {
  StructureType type = StructureType::bar;
  double youngs_modulus = 0.0;        ///< Pa, > 0
  double density = 0.0;               ///< kg/m^3, > 0
  double area = 0.0;                  ///< m^2, > 0
  double length = 0.0;                ///< m, > 0
  int elements = 0;                   ///< two-node elements, >= 1; as many degrees of freedom
  double stiffness_damping = 0.0;     ///< s, beta in C = beta K, >= 0
  double lumped_mass_fraction = 0.0;  ///< 0 consistent mass, 1 lumped mass, between them a mixture
  bool massless_tip = false;          ///< the tip's mass is moved to its neighbour: forced_response and sweep
  double modal_damping = 0.0;         ///< ratio to critical of every mode; not a bar's
  double loss_factor = 0.0;           ///< eta in K (1 + i eta) at positive harmonics, >= 0
  int kept_modes = -1;                ///< modes that a Craig-Bampton reduction keeps; -1: no reduction
  MatricesStructure matrices = {};
  BladeStructure blade = {};

  bool operator==(const Structure&) const = default;
};

}  // namespace wavebalance::app
