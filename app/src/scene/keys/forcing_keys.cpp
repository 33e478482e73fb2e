
#include "scene/keys/key_tables.hpp"

namespace wavebalance::app {
namespace {

SceneValue no_coefficients(const Scene&) { return std::vector<double>(); }

constexpr const char* table_help =
    "CSV file with the columns frequency_Hz, amplitude and optionally phase_degrees: factors "
    "on the amplitude over the forcing frequency, interpolated monotonically";

}  // namespace

void add_forcing_keys(std::vector<SceneKey>& keys) {
  const Section forcing(keys, "forcing", forcing_part);
  forcing(&Forcing::amplitude, "amplitude", "N",
          "force amplitude cos(2 pi frequency t): at the tip of a bar, at place of a blade, along "
          "load or load_dofs of matrices; default 0 with [[forcing.terms]]",
          required_with(analysis_where(&AnalysisKind::under_load)));
  keys.back().in_terms = true;
  forcing(&Forcing::amplitude_table, "amplitude_table", "", table_help, path, none_by_default());
  forcing(&Forcing::frequency, "frequency", "Hz",
          "forcing frequency; not used by sweeps and diagrams over the frequency", positive,
          required_with(analysis_where(&AnalysisKind::at_one_frequency)));
  forcing(&Forcing::load, "load", "",
          "load vector for amplitude 1: a file of one column, Nastran DMIG or OUTPUT4, Abaqus "
          "*CLOAD, or Harwell-Boeing with a right-hand side; \"job.pch#PAX:2\" selects a column of "
          "a matrix",
          path, optional, only_with(structure_is({"matrices"})));
  forcing(&Forcing::load_dofs, "load_dofs", "",
          "degrees of freedom under the whole force each, instead of load: rows counted from 1; -7 "
          "is row 7 in its negative direction; with dof_map also \"node 1042 z\" or \"-node 1042 "
          "z\"",
          optional, named_dofs, only_with(structure_is({"matrices"})));
  forcing(&Forcing::load_coefficients, "load_coefficients", "",
          "factor on the force at each of load_dofs; a name of several rows spreads it equally over them",
          derived("1.0 for each", no_coefficients), only_with(structure_is({"matrices"})));
  forcing(&Forcing::weight, "weight", "m/s^2",
          "acceleration of gravity along x, y and z, as [0, 0, -9.81]: static load on all masses "
          "of matrices with a dof_map",
          optional, exactly(3), only_with(structure_is({"matrices"})));
  forcing(&Forcing::place, "place", "", "corner nodes of the blade's tip under the force, in equal parts",
          optional, only_with(structure_is({"blade"})));
  forcing(&Forcing::direction, "direction", "",
          "direction of the force; the span is along z, the chord nearest to x", optional,
          only_with(structure_is({"blade"})));
}

std::vector<SceneKey> term_keys(std::size_t index) {
  std::vector<SceneKey> keys;
  const auto part = [index](auto& scene) -> auto& { return scene.forcing.terms[index]; };
  const Section term(keys, "forcing.terms", part);
  static const std::string term_table_help =
      std::string(table_help) + "; amplitude is 1 where it is not given";
  term(&ForcingTerm::kind, "kind", "",
       "kind of load: a force; a base_displacement, which prescribes dofs of matrices; a "
       "base_acceleration of all supports, with displacements relative to them; or an "
       "unbalance, which turns at harmonic times the frequency",
       derived("\"force\"", [](const Scene&) { return name_of(LoadKind::force); }));
  term(&ForcingTerm::amplitude, "amplitude", "",
       "amplitude of amplitude cos(harmonic 2 pi frequency t + phase) in N, m, m/s^2 or, for "
       "mass times eccentricity, kg m; or a factor on samples",
       derived("1.0 with samples", [](const Scene&) { return 1.0; }));
  term(&ForcingTerm::unit, "unit", "", "unit of the amplitude of a base_acceleration: g is 9.80665 m/s^2",
       one_of({"g"}), none_by_default());
  term(&ForcingTerm::amplitude_table, "amplitude_table", "", term_table_help, path, none_by_default());
  term(&ForcingTerm::harmonic, "harmonic", "", "multiple of frequency; 0 is a static load", within(0, 4096),
       derived("1", [](const Scene&) { return std::int64_t{1}; }));
  term(&ForcingTerm::phase, "phase", "degrees", "phase lead relative to a cosine; not for a static load",
       within(-360, 360), derived("0.0", 0.0));
  term(&ForcingTerm::samples, "samples", "",
       "CSV file with a header row; its last column is one period at uniform times from t = 0, "
       "instead of harmonic and phase",
       path, none_by_default());
  term(&ForcingTerm::dofs, "dofs", "",
       "matrices: rows under the whole force each, as load_dofs; base_displacement: rows that "
       "move; base_acceleration: rows along its direction; unbalance: two rows, turning from "
       "the first to the second, or one. Required except for a force",
       named_dofs, derived("as forcing.amplitude", [](const Scene&) { return std::vector<std::int64_t>(); }));
  term(&ForcingTerm::coefficients, "coefficients", "",
       "factor on a force at each of dofs; a name of several rows spreads it equally over them",
       derived("1.0 for each", no_coefficients));
  term(&ForcingTerm::load, "load", "",
       "matrices: load vector for amplitude 1, as forcing.load; instead of dofs", path, none_by_default());
  term(&ForcingTerm::direction, "direction", "",
       "matrices with a dof_map: direction of a base_acceleration; instead of dofs",
       one_of({"x", "y", "z", "-x", "-y", "-z"}), none_by_default());
  return keys;
}

}  // namespace wavebalance::app
