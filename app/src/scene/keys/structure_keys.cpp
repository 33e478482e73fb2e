#include "scene/keys/key_tables.hpp"
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::app {
namespace {

void add_materials(std::vector<SceneKey>& keys) {
  const Section either(keys, "structure", structure_part, structure_is({"bar", "blade"}));
  const Section blade(keys, "structure", blade_part, structure_is({"blade"}));
  const Condition bar = structure_is({"bar"});
  const fem::BladeOptions defaults;
  either(&Structure::youngs_modulus, "youngs_modulus", "Pa", "Young's modulus", positive,
         derived("1.1e11 for a blade", defaults.material.youngs_modulus), required_with(bar));
  blade(&BladeStructure::poissons_ratio, "poissons_ratio", "", "Poisson's ratio, below 0.5",
        within(-0.999, 0.499), optional);
  either(&Structure::density, "density", "kg/m^3", "mass density", positive,
         derived("4430.0 for a blade", defaults.material.density), required_with(bar));
  either(&Structure::length, "length", "m", "length of the bar or the blade", positive,
         derived("0.091 for a blade", defaults.length), required_with(bar));
}

void add_bar(std::vector<SceneKey>& keys) {
  const Section bar(keys, "structure", structure_part, structure_is({"bar"}));
  bar(&Structure::area, "area", "m^2", "cross-section", positive);
  bar(&Structure::elements, "elements", "", "number of two-node elements and degrees of freedom",
      within(1, 10'000'000));
  bar(&Structure::lumped_mass_fraction, "lumped_mass_fraction", "",
      "0: consistent mass matrix, 1: lumped, in between: a mixture", within(0, 1), optional);
  bar(&Structure::massless_tip, "massless_tip", "",
      "true moves the mass of the tip to its neighbour, which rigid contact requires", optional,
      only_with(of_responses()));
}

/// Analyses of structures whose matrices are not symmetric.
Condition of_turning() { return analysis_where(&AnalysisKind::any_matrices); }

void add_matrices(std::vector<SceneKey>& keys) {
  const Section matrices(keys, "structure", matrices_part, structure_is({"matrices"}));
  matrices(&MatricesStructure::mass, "mass", "kg",
           "mass matrix M, symmetric and positive definite: a file of Matrix Market, CalculiX, "
           "Abaqus (*MATRIX OUTPUT), Harwell-Boeing (Ansys, LS-DYNA) or Nastran (DMIG, OUTPUT4), "
           "detected from its first lines; \"job.pch#MAAX\" selects one of several",
           path);
  matrices(&MatricesStructure::stiffness, "stiffness", "N/m",
           "stiffness matrix K, in the same formats; positive definite unless structure.free = true", path);
  matrices(&MatricesStructure::damping, "damping", "N s/m",
           "damping matrix C, symmetric; instead of stiffness_damping or modal_damping", path, optional);
  matrices(&MatricesStructure::unsymmetric, "unsymmetric", "",
           "true accepts unsymmetric damping and stiffness (gyroscopic, circulatory); false reads "
           "an unsymmetric file as one triangle",
           optional, only_with(of_turning()));
  matrices(&MatricesStructure::gyroscopic, "gyroscopic", "N s^2/m",
           "gyroscopic matrix G of a rotor, skew-symmetric: the damping is C + spin_speed G", path, optional,
           only_with(of_turning()));
  matrices(&MatricesStructure::spin_stiffness, "spin_stiffness", "N s^2/m",
           "symmetric matrix K_s of spin stiffening: the stiffness is K + spin_speed^2 K_s", path, optional,
           only_with(of_turning()));
  matrices(&MatricesStructure::spin_speed, "spin_speed", "rad/s",
           "rotation speed with gyroscopic or spin_stiffness; 0: synchronous with the load, 2 pi "
           "times the frequency",
           not_negative, optional, only_with(of_turning()));
  matrices(&MatricesStructure::free, "free", "",
           "true accepts a free structure (K singular): only contact balances its static load, and "
           "rigid motions without contact keep a zero mean",
           optional, only_with(analysis_where([](const AnalysisKind& kind) {
             return kind.under_load && kind.type != AnalysisType::amplitude_sweep;
           })));
  matrices(&MatricesStructure::dof_map, "dof_map", "",
           "nodes and directions of the rows: the .dof file of CalculiX (a line 1042.3 per row), or "
           "text or CSV with the columns node, direction (x, y, z, rx, ry, rz, scalar or 1..6) and, "
           "unless in the order of the rows, row, as Ansys maps HBMAT; not needed if the stiffness "
           "names its nodes (DMIG, matrix input of Abaqus)",
           path, optional);
  matrices(
      &MatricesStructure::mesh, "mesh", "",
      "input file of CalculiX or Abaqus with nodes and elements, for motions in ParaView; requires a dof_map",
      path, optional);
  matrices(&MatricesStructure::contact_dofs, "contact_dofs", "",
           "contact degrees of freedom, as rows counted from 1; -7 is row 7 with its obstacle on "
           "the negative side; with dof_map also \"-node 1042 z\"; alternatively [[contact.pairs]]",
           optional, named_dofs);
}

void add_damping_and_reduction(std::vector<SceneKey>& keys) {
  const Section structure(keys, "structure", structure_part);
  const Condition modal = structure_is({"blade", "matrices"});
  structure(&Structure::stiffness_damping, "stiffness_damping", "s", "beta in C = beta K", not_negative,
            optional);
  structure(&Structure::modal_damping, "modal_damping", "",
            "damping ratio of every linear mode (0.02 for 2 %); instead of another damping", within(0, 1),
            optional, only_with(modal));
  structure(&Structure::loss_factor, "loss_factor", "",
            "eta of structural damping, K (1 + i eta) at the harmonics above zero, in addition to "
            "other damping. It has no equation in time: stability is unknown",
            not_negative, optional);
  structure(
      &Structure::kept_modes, "kept_modes", "",
      "fixed-interface modes of a Craig-Bampton reduction, in addition to the degrees of "
      "freedom in contact and under load (blade: all corner nodes of the tip)",
      within(0, 100'000),
      derived("40 for a blade; matrices are not reduced",
              [](const Scene& scene) { return scene.structure.type == StructureType::blade ? 40 : -1; }),
      only_with(modal));
}

void add_blade(std::vector<SceneKey>& keys) {
  using Blade = BladeStructure;
  const Section blade(keys, "structure", blade_part, structure_is({"blade"}));
  blade(&Blade::chord, "chord", "m", "chord at root and tip, linear between them", positive, optional);
  blade(&Blade::thickness_ratio, "thickness_ratio", "",
        "thickness at mid chord over the chord, at root and tip", positive, optional);
  blade(&Blade::camber_ratio, "camber_ratio", "", "camber over the chord, at root and tip", optional);
  blade(&Blade::angle_degrees, "angle_degrees", "degrees",
        "angle of the section from x to y, at root and tip", optional);
  blade(&Blade::edge_thickness, "edge_thickness", "", "thickness of the edges over that at mid chord",
        above(0, 1), optional);
  blade(&Blade::element, "element", "", "finite element", optional);
  blade(&Blade::chord_elements, "chord_elements", "", "elements along the chord", within(1, 10'000),
        optional);
  blade(&Blade::thickness_elements, "thickness_elements", "", "elements through the thickness",
        within(1, 1'000), optional);
  blade(&Blade::span_elements, "span_elements", "", "elements along the span", within(1, 10'000), optional);
  blade(&Blade::rotation_speed, "rotation_speed", "rad/s",
        "rotation speed; centrifugal forces stiffen the blade, and gaps refer to the rotating blade",
        not_negative, optional);
  blade(&Blade::hub_radius, "hub_radius", "m",
        "distance of the root z = 0 from the axis, which passes through z = -hub_radius", not_negative,
        optional);
  blade(&Blade::rotation_axis, "rotation_axis", "", "direction of the axis of rotation, of any length",
        optional);
}

}  // namespace

void add_structure_keys(std::vector<SceneKey>& keys) {
  const Section structure(keys, "structure", structure_part);
  structure(
      &Structure::type, "type", "",
      "kind of structure: a bar clamped at x = 0, a blade clamped at z = 0, or matrices from any finite "
      "element code");
  add_materials(keys);
  add_bar(keys);
  add_matrices(keys);
  add_damping_and_reduction(keys);
  add_blade(keys);
}

}  // namespace wavebalance::app
