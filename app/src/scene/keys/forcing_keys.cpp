#include <string>

#include "scene/keys/key_tables.hpp"

namespace wavebalance::app {
namespace {

SceneValue no_coefficients(const Scene&) { return std::vector<double>(); }

constexpr const char* table_help =
    "CSV file with the columns frequency_Hz, amplitude and, if wanted, phase_degrees over the frequency of the "
    "load: factors on amplitude, monotone between its rows";

}  // namespace

void add_forcing_keys(std::vector<SceneKey>& keys) {
  const Section forcing(keys, "forcing", forcing_part);
  forcing(&Forcing::amplitude, "amplitude", "N",
          "force amplitude cos(2 pi frequency t): at the tip of a bar, at one place of a blade's tip, along "
          "load or load_dofs of matrices; 0 where it is not given beside [[forcing.terms]]",
          required_with(analysis_where(&AnalysisKind::under_load)));
  keys.back().in_terms = true;
  forcing(&Forcing::amplitude_table, "amplitude_table", "", table_help, path, none_by_default());
  forcing(&Forcing::frequency, "frequency", "Hz", "frequency of the force; a sweep does not use it", positive,
          required_with(analysis_where(&AnalysisKind::at_one_frequency)));
  forcing(
      &Forcing::load, "load", "",
      "forces of all degrees of freedom for amplitude 1: a file of one column, DMIG or OUTPUT4 of Nastran, *CLOAD of "
      "Abaqus, or Harwell-Boeing with a right-hand side; \"job.pch#PAX:2\" is a column of one of several",
      path, optional, only_with(structure_is({"matrices"})));
  forcing(&Forcing::load_dofs, "load_dofs", "",
          "degrees of freedom that each take the whole force, rows counted from 1; -7 is row 7 in its "
          "negative direction; with dof_map also \"node 1042 z\" or \"-node 1042 z\"; in place of load",
          optional, named_dofs, only_with(structure_is({"matrices"})));
  forcing(&Forcing::load_coefficients, "load_coefficients", "",
          "the part of the force on each of load_dofs; a name of several rows spreads it equally over them",
          derived("1.0 for each", no_coefficients), only_with(structure_is({"matrices"})));
  forcing(
      &Forcing::weight, "weight", "m/s^2",
      "acceleration of gravity along x, y and z, as [0, 0, -9.81]: a static load on all masses of matrices "
      "with a dof_map",
      optional, exactly(3), only_with(structure_is({"matrices"})));
  forcing(&Forcing::place, "place", "", "corner nodes of the blade's tip that share the force", optional,
          only_with(structure_is({"blade"})));
  forcing(&Forcing::direction, "direction", "",
          "of the force; the blade stands along z, its chord nearest to x", optional,
          only_with(structure_is({"blade"})));
}

std::vector<SceneKey> term_keys(std::size_t index) {
  std::vector<SceneKey> keys;
  const auto part = [index](auto& scene) -> auto& { return scene.forcing.terms[index]; };
  const Section term(keys, "forcing.terms", part);
  static const std::string term_table_help =
      std::string(table_help) + "; amplitude is 1 where it is not given";
  term(
      &ForcingTerm::kind, "kind", "",
      "a force, or the motion of supports: a base_displacement moves dofs of matrices, which are then no "
      "unknowns, a base_acceleration moves all that holds the structure, with displacements relative to it; an "
      "unbalance turns with harmonic times the frequency and pulls with its square",
      derived("\"force\"", [](const Scene&) { return name_of(LoadKind::force); }));
  term(
      &ForcingTerm::amplitude, "amplitude", "",
      "in N, m, m/s^2 or, mass times eccentricity, kg m, of amplitude cos(harmonic 2 pi frequency t + phase), or a factor on samples",
      derived("1.0 with samples", [](const Scene&) { return 1.0; }));
  term(&ForcingTerm::unit, "unit", "", "of the amplitude of a base_acceleration: g is 9.80665 m/s^2",
       one_of({"g"}), none_by_default());
  term(&ForcingTerm::amplitude_table, "amplitude_table", "", term_table_help, path, none_by_default());
  term(&ForcingTerm::harmonic, "harmonic", "", "multiple of frequency; 0 is a static load", within(0, 4096),
       derived("1", [](const Scene&) { return std::int64_t{1}; }));
  term(&ForcingTerm::phase, "phase", "degrees", "by which it is ahead of a cosine; not of a static load",
       within(-360, 360), derived("0.0", 0.0));
  term(
      &ForcingTerm::samples, "samples", "",
      "CSV file with a header row, whose last column holds one period at uniform times from t = 0 on; in place "
      "of harmonic and phase",
      path, none_by_default());
  term(&ForcingTerm::dofs, "dofs", "",
       "matrices: rows that each take the whole force or move with the base, as load_dofs; required with a "
       "base, of which they are the rows that move (displacement) or point along its motion (acceleration), "
       "and with an unbalance: two rows, towards the second of which it turns from the first, or one",
       named_dofs,
       derived("those of forcing.amplitude", [](const Scene&) { return std::vector<std::int64_t>(); }));
  term(&ForcingTerm::coefficients, "coefficients", "",
       "of a force, the part of it on each of dofs; a name of several rows spreads it equally over them",
       derived("1.0 for each", no_coefficients));
  term(&ForcingTerm::load, "load", "",
       "matrices: forces of all degrees of freedom for amplitude 1, as forcing.load; in place of dofs", path,
       none_by_default());
  term(
      &ForcingTerm::direction, "direction", "",
      "matrices with a dof_map: of a base_acceleration, along which all nodes move with it; in place of dofs",
      one_of({"x", "y", "z", "-x", "-y", "-z"}), none_by_default());
  return keys;
}

}  // namespace wavebalance::app
