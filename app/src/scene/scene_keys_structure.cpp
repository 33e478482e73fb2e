#include "scene/scene_key_builders.hpp"
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::app {
namespace {

constexpr auto s = &Scene::structure;
constexpr std::string_view section = "structure";
constexpr int blade_modes = 40;

/// A bar has to say it, a blade has a default.
SceneKey blade_default(SceneKey key, std::string_view text, SceneValue (*rule)(const Scene&)) {
  return belonging(needed(derived(std::move(key), text, rule), structure_is({"bar"})),
                   structure_is({"bar", "blade"}));
}

void add_materials(std::vector<SceneKey>& keys) {
  keys.push_back(blade_default(
      bounded(key<s, &Structure::youngs_modulus>(section, "youngs_modulus", "Pa", "Young's modulus"),
              positive),
      "1.1e11 for a blade",
      [](const Scene&) -> SceneValue { return fem::BladeOptions{}.material.youngs_modulus; }));
  keys.push_back(belonging(optional(bounded(key<s, &Structure::blade, &BladeStructure::poissons_ratio>(
                                                section, "poissons_ratio", "", "Poisson's ratio, below 0.5"),
                                            {-0.999, 0.499})),
                           structure_is({"blade"})));
  keys.push_back(blade_default(
      bounded(key<s, &Structure::density>(section, "density", "kg/m^3", "mass density"), positive),
      "4430.0 for a blade", [](const Scene&) -> SceneValue { return fem::BladeOptions{}.material.density; }));
  keys.push_back(blade_default(
      bounded(key<s, &Structure::length>(section, "length", "m", "length of the bar or the blade"), positive),
      "0.091 for a blade", [](const Scene&) -> SceneValue { return fem::BladeOptions{}.length; }));
}

void add_bar(std::vector<SceneKey>& keys) {
  const auto add = [&keys](SceneKey key) {
    keys.push_back(belonging(std::move(key), structure_is({"bar"})));
  };
  add(bounded(key<s, &Structure::area>(section, "area", "m^2", "cross-section"), positive));
  add(bounded(key<s, &Structure::elements>(section, "elements", "",
                                           "two-node elements, as many as degrees of freedom"),
              {1, 10'000'000}));
  add(optional(bounded(key<s, &Structure::lumped_mass_fraction>(
                           section, "lumped_mass_fraction", "",
                           "0 for the consistent mass matrix, 1 for the lumped one, between them a mixture"),
                       {0, 1})));
  keys.push_back(belonging(
      optional(key<s, &Structure::massless_tip>(section, "massless_tip", "",
                                                "true moves the tip's mass to its neighbour, so that rigid "
                                                "contact has no mass to stop at once")),
      structure_is({"bar"}) && analysis_is({"forced_response", "frequency_sweep"})));
}

template <auto Member>
SceneKey matrices(std::string_view name, std::string_view unit, std::string_view help) {
  return belonging(key<s, &Structure::matrices, Member>(section, name, unit, help),
                   structure_is({"matrices"}));
}

void add_matrices(std::vector<SceneKey>& keys) {
  keys.push_back(path(matrices<&MatricesStructure::mass>(
      "mass", "kg", "mass matrix M: Matrix Market coordinate file, symmetric and positive definite")));
  keys.push_back(path(matrices<&MatricesStructure::stiffness>(
      "stiffness", "N/m", "stiffness matrix K, likewise; the structure must not be free to move")));
  keys.push_back(optional(path(matrices<&MatricesStructure::damping>(
      "damping", "N s/m", "damping matrix C, symmetric; in place of stiffness_damping or modal_damping"))));
  keys.push_back(
      bounded(matrices<&MatricesStructure::contact_dofs>(
                  "contact_dofs", "",
                  "degrees of freedom that may touch an obstacle, rows of the matrices counted from "
                  "1; -7 is row 7 with its obstacle on the negative side"),
              {-2147483647, 2147483647}));
}

void add_damping(std::vector<SceneKey>& keys) {
  keys.push_back(optional(
      bounded(key<s, &Structure::stiffness_damping>(section, "stiffness_damping", "s", "beta in C = beta K"),
              not_negative)));
  keys.push_back(belonging(
      optional(bounded(key<s, &Structure::modal_damping>(
                           section, "modal_damping", "",
                           "damping of every linear mode over its critical one; in place of another damping"),
                       {0, 10})),
      structure_is({"blade", "matrices"})));
}

void add_reduction(std::vector<SceneKey>& keys) {
  keys.push_back(belonging(
      derived(
          bounded(key<s, &Structure::kept_modes>(
                      section, "kept_modes", "",
                      "modes that a Craig-Bampton reduction keeps beside the degrees of freedom in contact "
                      "and under load (a blade: all of its tip's corner nodes)"),
                  {0, 100'000}),
          "40 for a blade; matrices are not reduced",
          [](const Scene& scene) -> SceneValue {
            return std::int64_t{scene.structure.type == StructureType::blade ? blade_modes : -1};
          }),
      structure_is({"blade", "matrices"})));
}

template <auto Member>
SceneKey blade(std::string_view name, std::string_view unit, std::string_view help, Bounds bounds = {}) {
  return belonging(optional(bounded(key<s, &Structure::blade, Member>(section, name, unit, help), bounds)),
                   structure_is({"blade"}));
}

void add_blade_shape(std::vector<SceneKey>& keys) {
  keys.push_back(
      blade<&BladeStructure::chord>("chord", "m", "chord at root and tip, linear between them", positive));
  keys.push_back(blade<&BladeStructure::thickness_ratio>(
      "thickness_ratio", "", "thickness at mid chord over the chord, at root and tip", positive));
  keys.push_back(
      blade<&BladeStructure::camber_ratio>("camber_ratio", "", "camber over the chord, at root and tip"));
  keys.push_back(blade<&BladeStructure::angle_degrees>("angle_degrees", "degrees",
                                                       "angle of the section from x to y, at root and tip"));
  keys.push_back(blade<&BladeStructure::edge_thickness>(
      "edge_thickness", "", "thickness of the edges over that at mid chord", {0.0, 1.0, true}));
  keys.push_back(blade<&BladeStructure::element>("element", "", "finite element"));
  keys.push_back(
      blade<&BladeStructure::chord_elements>("chord_elements", "", "elements along the chord", {1, 10'000}));
  keys.push_back(blade<&BladeStructure::thickness_elements>("thickness_elements", "",
                                                            "elements through the thickness", {1, 1'000}));
  keys.push_back(
      blade<&BladeStructure::span_elements>("span_elements", "", "elements along the span", {1, 10'000}));
}

void add_rotation(std::vector<SceneKey>& keys) {
  keys.push_back(blade<&BladeStructure::rotation_speed>(
      "rotation_speed", "rad/s",
      "speed of rotation, whose centrifugal force stiffens the blade; gaps are those of the turning blade",
      not_negative));
  keys.push_back(blade<&BladeStructure::hub_radius>(
      "hub_radius", "m", "distance of the root z = 0 from the axis, which passes through z = -hub_radius",
      not_negative));
  keys.push_back(blade<&BladeStructure::rotation_axis>("rotation_axis", "",
                                                       "direction of the axis of rotation, of any length"));
}

}  // namespace

void add_structure_keys(std::vector<SceneKey>& keys) {
  keys.push_back(key<s, &Structure::type>(
      section, "type", "",
      "kind of structure: a bar clamped at x = 0, a blade clamped at z = 0, or matrices from any finite "
      "element code"));
  add_materials(keys);
  add_bar(keys);
  add_matrices(keys);
  add_damping(keys);
  add_reduction(keys);
  add_blade_shape(keys);
  add_rotation(keys);
}

}  // namespace wavebalance::app
