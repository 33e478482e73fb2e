#include <cmath>

#include "scene/scene_key_builder.hpp"
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::app {
namespace {

constexpr auto structure_part = [](auto& scene) -> auto& { return scene.structure; };
constexpr auto matrices_part = [](auto& scene) -> auto& { return scene.structure.matrices; };
constexpr auto blade_part = [](auto& scene) -> auto& { return scene.structure.blade; };
constexpr auto contact_part = [](auto& scene) -> auto& { return scene.contact; };
constexpr auto forcing_part = [](auto& scene) -> auto& { return scene.forcing; };
constexpr auto time_part = [](auto& scene) -> auto& { return scene.time; };
constexpr auto analysis_part = [](auto& scene) -> auto& { return scene.analysis; };

Condition structure_is(std::vector<std::string_view> types) { return {"structure.type", std::move(types)}; }
Condition law_is(std::vector<std::string_view> laws) { return {"contact.law", std::move(laws)}; }
Condition analysis_is(std::vector<std::string_view> types) { return {"analysis.type", std::move(types)}; }

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
  bar(&Structure::elements, "elements", "", "two-node elements, as many as degrees of freedom",
      within(1, 10'000'000));
  bar(&Structure::lumped_mass_fraction, "lumped_mass_fraction", "",
      "0 for the consistent mass matrix, 1 for the lumped one, between them a mixture", within(0, 1),
      optional);
  bar(&Structure::massless_tip, "massless_tip", "",
      "true moves the tip's mass to its neighbour, so that rigid contact has no mass to stop at once",
      optional, only_with(analysis_is({"forced_response", "frequency_sweep"})));
}

void add_matrices(std::vector<SceneKey>& keys) {
  const Section matrices(keys, "structure", matrices_part, structure_is({"matrices"}));
  matrices(&MatricesStructure::mass, "mass", "kg",
           "mass matrix M, symmetric and positive definite: a file in the format of Matrix Market (.mtx), "
           "CalculiX (.sti, .mas) or Harwell-Boeing (.rsa, .rua; Ansys, LS-DYNA), known by its first lines",
           path);
  matrices(&MatricesStructure::stiffness, "stiffness", "N/m",
           "stiffness matrix K, likewise; the structure must not be free to move", path);
  matrices(&MatricesStructure::damping, "damping", "N s/m",
           "damping matrix C, symmetric; in place of stiffness_damping or modal_damping", path, optional);
  matrices(
      &MatricesStructure::dof_map, "dof_map", "",
      "names the rows by nodes: the .dof file of CalculiX (a line 1042.3 per row), or text or CSV with the "
      "columns node, direction (x, y, z, rx, ry, rz or 1..6) and, unless in the order of the rows, row",
      path, optional);
  matrices(
      &MatricesStructure::contact_dofs, "contact_dofs", "",
      "degrees of freedom that may touch an obstacle, rows of the matrices counted from 1; -7 is row 7 "
      "with its obstacle on the negative side; with dof_map also \"-node 1042 z\"; or else [[contact.pairs]]",
      optional, named_dofs);
}

void add_damping_and_reduction(std::vector<SceneKey>& keys) {
  const Section structure(keys, "structure", structure_part);
  const Condition modal = structure_is({"blade", "matrices"});
  structure(&Structure::stiffness_damping, "stiffness_damping", "s", "beta in C = beta K", not_negative,
            optional);
  structure(&Structure::modal_damping, "modal_damping", "",
            "damping of every linear mode over its critical one; in place of another damping", within(0, 10),
            optional, only_with(modal));
  structure(
      &Structure::kept_modes, "kept_modes", "",
      "modes that a Craig-Bampton reduction keeps beside the degrees of freedom in contact and under "
      "load (a blade: all of its tip's corner nodes)",
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
        "speed of rotation, whose centrifugal force stiffens the blade; gaps are those of the turning blade",
        not_negative, optional);
  blade(&Blade::hub_radius, "hub_radius", "m",
        "distance of the root z = 0 from the axis, which passes through z = -hub_radius", not_negative,
        optional);
  blade(&Blade::rotation_axis, "rotation_axis", "", "direction of the axis of rotation, of any length",
        optional);
}

SceneValue get_gap(const Scene& scene) {
  if (scene.contact.gaps.empty()) return scene.contact.gap;
  return scene.contact.gaps;
}

void set_gap(Scene& scene, const SceneValue& value) {
  Contact& contact = scene.contact;
  const auto* list = std::get_if<std::vector<double>>(&value);
  const bool one = list == nullptr || list->size() == 1;
  contact.gap = list == nullptr ? std::get<double>(value) : one ? list->front() : 0.0;
  contact.gaps = one ? std::vector<double>{} : *list;
}

std::vector<std::string_view> basis_names() {
  return {"fourier",      "haar",         "bspline",      "daubechies2",  "daubechies4",  "daubechies6",
          "daubechies8",  "daubechies10", "daubechies12", "daubechies14", "daubechies16", "daubechies18",
          "daubechies20", "daubechies22", "daubechies24", "daubechies26", "daubechies28", "daubechies30",
          "daubechies32", "daubechies34", "daubechies36", "daubechies38", "daubechies40"};
}

/// The interval of a sweep over `parts`.
auto interval_over(int parts) {
  return [parts](const Scene& scene) {
    return std::abs(scene.analysis.frequency_to - scene.analysis.frequency_from) / parts;
  };
}

void add_sweep(std::vector<SceneKey>& keys) {
  const Section sweep(keys, "analysis", analysis_part, analysis_is({"frequency_sweep"}));
  sweep(&Analysis::frequency_from, "frequency_from", "Hz", "where the branch starts", positive);
  sweep(&Analysis::frequency_to, "frequency_to", "Hz", "where the branch ends, above or below its start",
        positive);
  sweep(&Analysis::first_step, "first_step", "Hz", "first step along the branch", positive,
        derived("|frequency_to - frequency_from| / 1000", interval_over(1000)));
  sweep(&Analysis::largest_step, "largest_step", "Hz",
        "no step along the branch is larger; a displacement by the gap counts as a 20th of the interval",
        positive, derived("|frequency_to - frequency_from| / 80", interval_over(80)));
  sweep(&Analysis::max_points, "max_points", "", "the branch is given up after so many",
        within(2, 10'000'000), optional);
  sweep(&Analysis::branches, "branches", "",
        "true also follows the curves that begin at period doublings and at branch points", optional);
}

void add_time_stepping(std::vector<SceneKey>& keys) {
  const Section stepping(keys, "analysis", analysis_part, analysis_is({"time_stepping"}));
  stepping(&Analysis::tolerance, "tolerance", "",
           "relative rms difference of two successive periods to be reached", above(0, 1), optional);
  stepping(&Analysis::max_periods, "max_periods", "", "given up after so many periods",
           within(1, 100'000'000), optional);
}

void add_mode(std::vector<SceneKey>& keys) {
  const Section mode(keys, "analysis", analysis_part, analysis_is({"nonlinear_mode"}));
  mode(&Analysis::formulation, "formulation", "",
       "consistent: the equation of motion holds at every point; published: the equations of Laxalde & "
       "Legrand as printed, by their augmented Lagrangian, with the root of the Rayleigh quotient as "
       "frequency (runs with few harmonics only)",
       optional);
  mode(&Analysis::mode, "mode", "", "the linear mode that the nonlinear one continues", within(1, 10'000'000),
       optional);
  mode(&Analysis::harmonics, "harmonics", "", "harmonics N of the Fourier series in time", within(1, 4096),
       optional);
  mode(
      &Analysis::samples, "samples", "",
      "uniform times of one period at which contact is enforced, at least 2 x harmonics; with an exponential "
      "or linear law those of its force",
      within(2, 1 << 16),
      derived("2 x harmonics, 8 x with an exponential or linear law", [](const Scene& scene) {
        return (scene.contact.law == ContactLawType::rigid ? 2 : 8) * scene.analysis.harmonics;
      }));
  mode(&Analysis::cosine_only, "cosine_only", "", "true seeks motions that are even in time only", optional);
  mode(&Analysis::energy_ratio, "energy_ratio", "",
       "the one motion of this energy, over that of the linear mode that just touches; 0 for the curve",
       not_negative, optional);
  mode(&Analysis::largest_energy, "largest_energy", "", "the curve ends beyond this energy ratio", above(1),
       optional);
  mode(&Analysis::last_frequency_ratio, "last_frequency_ratio", "",
       "or beyond this ratio of the frequency to the linear one", above(1.001), optional);
  mode(&Analysis::points, "points", "",
       "of the curve, uniform in frequency up to there; in energy when published; about as many with an "
       "exponential or linear law",
       within(2, 1'000'000), optional);
}

void add_structure(std::vector<SceneKey>& keys) {
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

void add_contact(std::vector<SceneKey>& keys) {
  const Section contact(keys, "contact", contact_part);
  contact(&Contact::law, "law", "",
          "force on each degree of freedom in contact (a bar: its tip; a blade: its tip's corner nodes, "
          "radially) once its displacement u exceeds the gap: constant (exp(exponent (u - gap)) - 1), "
          "stiffness (u - gap), or, rigid, whatever keeps u at the gap",
          optional);
  contact(&Contact::constant, "constant", "N", "a_c of the exponential law", positive, or_in_pairs,
          only_with(law_is({"exponential"})));
  contact(&Contact::exponent, "exponent", "1/m", "alpha of the exponential law", positive, or_in_pairs,
          only_with(law_is({"exponential"})));
  contact(&Contact::stiffness, "stiffness", "N/m", "slope of the linear law", positive, or_in_pairs,
          only_with(law_is({"linear"})));
  contact(&Contact::gap, "gap", "m",
          "displacement towards the obstacle at which contact starts; a list has one for each degree of "
          "freedom in contact",
          single_or_list(get_gap, set_gap), or_in_pairs,
          only_with(law_is({"exponential", "linear", "rigid"})));
  const Condition balanced = analysis_is({"forced_response", "frequency_sweep"});
  contact(
      &Contact::form, "form", "",
      "unknown in which contact is solved: the displacement, or for stiff and rigid laws the contact force",
      optional, only_with(balanced));
  contact(&Contact::mass, "mass", "",
          "mass of the contacts: keep it, or redistribute it to the rest of the structure, without which a "
          "rigid obstacle leaves a continuum of motions; automatic redistributes it for a rigid law, but not "
          "in nonlinear modes",
          optional, only_with(analysis_is({"forced_response", "frequency_sweep", "nonlinear_mode"})));
}

void add_forcing(std::vector<SceneKey>& keys) {
  const Section forcing(keys, "forcing", forcing_part);
  forcing(&Forcing::amplitude, "amplitude", "N",
          "force amplitude cos(2 pi frequency t): at the tip of a bar, at one place of a blade's tip, along "
          "load or load_dofs of matrices",
          required_with(analysis_is({"forced_response", "frequency_sweep", "time_stepping"})));
  forcing(&Forcing::frequency, "frequency", "Hz", "frequency of the force; a sweep does not use it", positive,
          required_with(analysis_is({"forced_response", "time_stepping"})));
  forcing(&Forcing::load, "load", "",
          "forces of all degrees of freedom for amplitude 1: Matrix Market array file of one column", path,
          optional, only_with(structure_is({"matrices"})));
  forcing(&Forcing::load_dofs, "load_dofs", "",
          "degrees of freedom that each take the whole force, rows counted from 1; -7 is row 7 in its "
          "negative direction; with dof_map also \"node 1042 z\" or \"-node 1042 z\"; in place of load",
          optional, named_dofs, only_with(structure_is({"matrices"})));
  forcing(&Forcing::place, "place", "", "corner nodes of the blade's tip that share the force", optional,
          only_with(structure_is({"blade"})));
  forcing(&Forcing::direction, "direction", "",
          "of the force; the blade stands along z, its chord nearest to x", optional,
          only_with(structure_is({"blade"})));
}

void add_time(std::vector<SceneKey>& keys) {
  const Section time(keys, "time", time_part);
  const Condition balance = analysis_is({"forced_response", "frequency_sweep"}).unless("time.tolerance");
  time(&Time::tolerance, "tolerance", "",
       "relative rms error of the contact displacement over the period to be met, in place of functions and "
       "quadrature_points, which the program then chooses, and, where trial and weight are left out, of "
       "these too",
       within(0, 1), derived("none", 0.0), only_with(analysis_is({"forced_response"})));
  time(&Time::trial, "trial", "", "basis of the displacement in time", one_of(basis_names()),
       required_with(balance));
  time(&Time::weight, "weight", "", "basis that the residual is weighted with", one_of(basis_names()),
       required_with(balance));
  time(&Time::functions, "functions", "", "trial functions; a power of two for wavelets", within(1, 1 << 20),
       required_with(balance));
  time(&Time::formulation, "formulation", "", "how many derivatives move to the weights: none, one or two",
       optional);
  time(&Time::quadrature_points, "quadrature_points", "",
       "uniform points of one period where the contact force is evaluated; a multiple of functions for "
       "wavelets",
       within(1, 1 << 24),
       derived("4 x functions", [](const Scene& scene) { return 4 * scene.time.functions; }));
  time(&Time::sample_offset, "sample_offset", "",
       "first quadrature point in intervals of the points: 0 for their left ends k/N, 0.5 for their middles "
       "(k + 0.5)/N; without effect on output_points",
       optional, only_with(analysis_is({"forced_response", "frequency_sweep"})));
  time(&Time::inner_products, "inner_products", "",
       "inner products of trial and weight functions: sums over the quadrature points (Daubechies Galerkin "
       "pairs: connection coefficients) or exact",
       optional);
  time(
      &Time::nyquist, "nyquist", "",
      "the alternating coefficient of an even number of functions, which no damping acts on: drop takes it out "
      "of trial and weight space, keep leaves it there with resonances of its own; without effect for an odd "
      "number",
      optional);
}

int contacts_of(const Scene& scene) {
  if (scene.structure.type == StructureType::bar) return 1;
  if (scene.structure.type == StructureType::blade)
    return 2 * (scene.structure.blade.chord_elements + 1);  // nodes along its tip
  return static_cast<int>(scene.structure.matrices.contact_dofs.size() +
                          scene.contact.pair_contacts().size());
}

/// Whether counts take a few times as long as the curve, or less.
SceneValue stability_by_default(const Scene& scene) {
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  if (scene.analysis.type != AnalysisType::frequency_sweep && !mode) return true;
  if (mode && scene.contact.law == ContactLawType::rigid) return true;  // not known
  constexpr int few = 6;
  constexpr int most_unknowns = 400;  // contacts times functions, beyond which a count takes tens of points
  const int contacts = contacts_of(scene);
  return contacts <= few || (!mode && contacts * scene.time.functions <= most_unknowns);
}

void add_analysis(std::vector<SceneKey>& keys) {
  const Section analysis(keys, "analysis", analysis_part);
  analysis(&Analysis::type, "type", "", "what is computed", optional);
  analysis(&Analysis::output_points, "output_points", "", "uniform points of one period in response.csv",
           within(2, 1 << 24), optional);
  analysis(
      &Analysis::motion_points, "motion_points", "",
      "instants of one motion's period at which the whole structure is written: a blade to motion.pvd "
      "for ParaView, matrices to motion.mtx, a column an instant",
      within(0, 9999),
      derived("32 for a blade, 0 for matrices",
              [](const Scene& scene) { return scene.structure.type == StructureType::blade ? 32 : 0; }),
      only_with(structure_is({"blade", "matrices"}) && analysis_is({"forced_response", "nonlinear_mode"})));
  analysis(&Analysis::stability, "stability", "",
           "true counts the Floquet multipliers outside the unit circle, of a motion or of each point of a "
           "curve, and finds the curve's special points",
           derived("true; with more than 6 contacts false for modes, and for curves where contacts times "
                   "functions exceed 400",
                   stability_by_default),
           only_with(analysis_is({"forced_response", "frequency_sweep", "nonlinear_mode"})));
  analysis(&Analysis::subharmonic, "subharmonic", "",
           "n seeks motions that repeat after n periods of the load; functions, quadrature_points and "
           "output_points are then those of n periods",
           within(1, 1024), optional, only_with(analysis_is({"forced_response", "frequency_sweep"})));
  add_sweep(keys);
  add_time_stepping(keys);
  add_mode(keys);
}

std::vector<SceneKey> make_keys() {
  std::vector<SceneKey> keys;
  add_structure(keys);
  add_contact(keys);
  add_forcing(keys);
  add_time(keys);
  add_analysis(keys);
  return keys;
}

}  // namespace

std::vector<SceneKey> pair_keys(std::size_t index) {
  std::vector<SceneKey> keys;
  const auto part = [index](auto& scene) -> auto& { return scene.contact.pairs[index]; };
  const Section pair(keys, "contact.pairs", part);
  const auto of_contact = [](auto Contact::*member) {
    return derived("that of [contact]", [=](const Scene& scene) { return value_of(scene.contact.*member); });
  };
  pair(
      &ContactPair::dofs, "dofs", "",
      "degrees of freedom whose weighted sum is the displacement in contact, rows of the matrices counted from "
      "1 or with dof_map \"node 1042 z\": two nodes that face each other, or the components along the normal of "
      "a surface",
      within(1, 100'000'000), named_dofs);
  pair(&ContactPair::coefficients, "coefficients", "", "their weights, one for each", within(-1e9, 1e9),
       derived("[1.0] for one of dofs, [1.0, -1.0] for two", [=](const Scene& scene) {
         return part(scene).dofs.size() == 1 ? std::vector<double>{1.0} : std::vector<double>{1.0, -1.0};
       }));
  pair(&ContactPair::side, "side", "",
       "where the obstacle stands: the displacement may exceed gap, or -gap on the negative side, or both",
       derived("\"positive\"", [](const Scene&) { return name_of(ObstacleSide::positive); }));
  pair(&ContactPair::law, "law", "", "contact law of this pair", one_of({"exponential", "linear"}),
       of_contact(&Contact::law));
  pair(&ContactPair::constant, "constant", "N", "a_c of its exponential law", positive,
       of_contact(&Contact::constant));
  pair(&ContactPair::exponent, "exponent", "1/m", "alpha of its exponential law", positive,
       of_contact(&Contact::exponent));
  pair(&ContactPair::stiffness, "stiffness", "N/m", "slope of its linear law", positive,
       of_contact(&Contact::stiffness));
  pair(&ContactPair::gap, "gap", "m", "displacement towards its obstacle at which contact starts",
       of_contact(&Contact::gap));
  return keys;
}

std::span<const SceneKey> scene_keys() {
  static const std::vector<SceneKey> keys = make_keys();
  return keys;
}

}  // namespace wavebalance::app
