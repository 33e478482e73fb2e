#include "wavebalance/app/scene/scene.hpp"

#include <algorithm>
#include <charconv>
#include <numbers>

#include "scene/enum_names.hpp"
#include "wavebalance/contact/catalogue.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace wavebalance::app {

std::string name_of(StructureType value) { return std::string(enum_name(value)); }
std::string name_of(SolidElement value) { return std::string(enum_name(value)); }
std::string name_of(Direction value) { return std::string(enum_name(value)); }
std::string name_of(TipPlace value) { return std::string(enum_name(value)); }
std::string name_of(ObstacleSide value) { return std::string(enum_name(value)); }
std::string name_of(Formulation value) { return std::string(enum_name(value)); }
std::string name_of(InnerProducts value) { return std::string(enum_name(value)); }
std::string name_of(NyquistCoefficient value) { return std::string(enum_name(value)); }
std::string name_of(AnalysisType value) { return std::string(enum_name(value)); }
std::string name_of(TimeMethod value) { return std::string(enum_name(value)); }
std::string name_of(LoadKind value) { return std::string(enum_name(value)); }

std::string_view unit_of(LoadKind kind) {
  switch (kind) {
    case LoadKind::force:
      return "N";
    case LoadKind::base_displacement:
      return "m";
    case LoadKind::base_acceleration:
      return "m/s^2";
    case LoadKind::unbalance:
      return "kg m";
  }
  return "";
}

std::string_view unit_of(const ForcingTerm& term) { return term.unit == "g" ? "g" : unit_of(term.kind); }

double spin_speed(const Scene& scene) {
  const MatricesStructure& structure = scene.structure.matrices;
  if (structure.gyroscopic.empty() && structure.spin_stiffness.empty()) return 0.0;
  return structure.spin_speed > 0.0 ? structure.spin_speed : 2.0 * std::numbers::pi * scene.forcing.frequency;
}

bool turns_along_curve(const Scene& scene) {
  const MatricesStructure& structure = scene.structure.matrices;
  return scene.analysis.type == AnalysisType::frequency_sweep && structure.spin_speed == 0.0 &&
         !(structure.gyroscopic.empty() && structure.spin_stiffness.empty());
}

std::optional<ReferenceLoad> reference_load(const Forcing& forcing) {
  if (forcing.amplitude != 0.0) return ReferenceLoad{forcing.amplitude, "N"};
  for (const ForcingTerm& term : forcing.terms) {
    if (term.amplitude == 0.0 || (term.harmonic == 0 && term.samples.empty())) continue;
    return ReferenceLoad{term.amplitude, unit_of(term)};
  }
  return std::nullopt;
}

bool has_gap(std::string_view law) { return contact::law_entry(law).has_gap() && !acts_in_plane(law); }
bool is_damped(std::string_view law) { return contact::law_entry(law).reads_velocity; }
bool acts_on_both_sides(std::string_view law) { return !contact::law_entry(law).beyond_gap_alone; }
bool acts_everywhere(std::string_view law) {
  return law != no_law && !has_gap(law) && !has_friction(law) && acts_on_both_sides(law);
}
bool is_rigid(std::string_view law) { return contact::law_entry(law).rigid; }
bool acts_in_plane(std::string_view law) { return contact::law_entry(law).acts_in_plane; }
bool reads_signal(std::string_view law) { return contact::law_entry(law).reads_signal; }

namespace {

bool names(const Contact& contact, bool (*wanted)(std::string_view)) {
  return wanted(contact.law) ||
         std::ranges::any_of(contact.pairs, [&](const ContactPair& pair) { return wanted(pair.law); });
}

}  // namespace

bool names_plane(const Contact& contact) { return names(contact, acts_in_plane); }
bool names_signal(const Contact& contact) { return names(contact, reads_signal); }
bool names_coupled_rows(const Contact& contact) { return names_plane(contact) || names_signal(contact); }
bool names_friction(const Contact& contact) { return names(contact, has_friction); }

bool takes_energy(const Contact& contact) { return names_friction(contact) || names(contact, is_damped); }

namespace {

/// Whether a contact has friction of a kind.
template <class Kind>
bool rubs(const Contact& contact, Kind kind) {
  const auto is_it = [&](const auto& one) { return has_friction(one.law) && kind(one.values); };
  return contact.pairs.empty() ? is_it(contact) : std::ranges::any_of(contact.pairs, is_it);
}

}  // namespace

bool names_rigid_friction(const Contact& contact) {
  return rubs(contact,
              [](const contact::LawValues& values) { return !values.contains("tangential_stiffness"); });
}

bool names_friction_of_states(const Contact& contact) {
  return rubs(contact, [](const contact::LawValues& values) {
    const auto given = [&](std::string_view name) { return contact::number_or(values, name, 0.0); };
    return given("surface_speed") != 0.0 || given("tangential_damping") > 0.0 ||
           given("normal_damping") > 0.0 || given("static_friction") > given("friction");
  });
}

bool has_friction(std::string_view law) { return contact::law_entry(law).acts_over_period; }
bool has_impacts(const Contact& contact) {
  return is_rigid(contact.law) && contact.values.contains("restitution");
}

bool moves_by_events(const Scene& scene) {
  const Contact& contact = scene.contact;
  const bool free = scene.structure.matrices.free;
  if (kind_of(scene.analysis.type).motions_by == MotionsBy::events) return true;
  if (has_impacts(contact))
    return free ||
           std::ranges::any_of(contact.pairs, [](const ContactPair& pair) { return !is_rigid(pair.law); });
  if (free && (names_friction(contact) || names_coupled_rows(contact))) return true;
  if (names_friction_of_states(contact)) return true;
  const bool kept = contact.mass == ContactMass::keep ||
                    (contact.mass == ContactMass::automatic && scene.time.trial.empty() &&
                     scene.analysis.type != AnalysisType::nonlinear_mode);
  return kept && !scene.structure.massless_tip && names_rigid_friction(contact);
}

bool solves_by_impacts(const Scene& scene) { return has_impacts(scene.contact) && !moves_by_events(scene); }

bool seeks_by_events(const Scene& scene) {
  return has_impacts(scene.contact) || moves_by_events(scene) || names_friction(scene.contact) ||
         names_coupled_rows(scene.contact);
}

Scene with_longer_period(Scene scene, int times) {
  Time& time = scene.time;
  const bool odd = time.functions % 2 == 1 && !is_wavelet(time.trial) && !is_wavelet(time.weight);
  time.functions = odd ? times * (time.functions - 1) + 1 : times * time.functions;
  time.quadrature_points *= times;
  scene.analysis.output_points *= times;
  scene.analysis.subharmonic *= times;
  return scene;
}

const AnalysisKind& kind_of(AnalysisType type) {
  return *std::ranges::find_if(analysis_kinds,
                               [type](const AnalysisKind& kind) { return kind.type == type; });
}

bool integrates_in_time(AnalysisType type) { return kind_of(type).motions_by == MotionsBy::time; }

bool is_sweep(AnalysisType type) {
  return type == AnalysisType::frequency_sweep || type == AnalysisType::amplitude_sweep;
}

bool is_over_amplitude(const Analysis& analysis) {
  return analysis.type == AnalysisType::amplitude_sweep ||
         (analysis.type == AnalysisType::bifurcation_diagram && analysis.amplitude_to > 0.0);
}

bool varies_frequency(const Analysis& analysis) {
  return analysis.type == AnalysisType::frequency_sweep ||
         (analysis.type == AnalysisType::bifurcation_diagram && !is_over_amplitude(analysis));
}

std::pair<double, double> sweep_interval(const Analysis& analysis) {
  if (is_over_amplitude(analysis)) return {analysis.amplitude_from, analysis.amplitude_to};
  return {analysis.frequency_from, analysis.frequency_to};
}

bool names_exact_method(const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  return !has_impacts(scene.contact) &&
         (kind_of(type).is_exact() ||
          (type == AnalysisType::forced_response && scene.time.method == TimeMethod::exact));
}

bool solves_exactly(const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  if (moves_by_events(scene))
    return type == AnalysisType::shooting || type == AnalysisType::forced_response ||
           kind_of(type).motions_by == MotionsBy::events;
  return names_exact_method(scene);
}

namespace {

void add_files(std::vector<std::string>& files, const contact::LawValues& values) {
  for (const auto& [name, value] : values)
    if (const auto* file = std::get_if<std::string>(&value)) files.push_back(*file);
}

}  // namespace

std::vector<std::string> input_files(const Scene& scene) {
  const MatricesStructure& matrices = scene.structure.matrices;
  std::vector<std::string> files{matrices.mass,           matrices.stiffness, matrices.damping,
                                 matrices.dof_map,        matrices.mesh,      matrices.gyroscopic,
                                 matrices.spin_stiffness, scene.forcing.load, scene.forcing.amplitude_table};
  add_files(files, scene.contact.values);
  for (const ForcingTerm& term : scene.forcing.terms)
    files.insert(files.end(), {term.samples, term.load, term.amplitude_table});
  for (const ContactPair& pair : scene.contact.pairs) add_files(files, pair.values);
  std::erase(files, "");
  for (std::string& file : files) file = file_of_input(file);
  return files;
}

std::string file_of_input(const std::string& path) { return fem::matrix_place(path).file.string(); }

bool redistributes_mass(const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  if (integrates_in_time(type) || has_impacts(scene.contact) || moves_by_events(scene)) return false;
  const bool rigid = (is_rigid(scene.contact.law) || names_rigid_friction(scene.contact)) &&
                     type != AnalysisType::nonlinear_mode;
  return scene.contact.mass == ContactMass::redistribute ||
         (scene.contact.mass == ContactMass::automatic && rigid && !scene.structure.massless_tip);
}

int daubechies_coefficients(const std::string& basis) {
  if (basis == "fourier" || basis == "haar" || basis == "bspline") return 0;
  constexpr std::string_view family = "daubechies";
  int coefficients = 0;
  if (basis.starts_with(family)) {
    const char* end = basis.data() + basis.size();
    const auto parsed = std::from_chars(basis.data() + family.size(), end, coefficients);
    if (parsed.ec != std::errc{} || parsed.ptr != end) coefficients = 0;
  }
  if (coefficients < 2 || coefficients > 40 || coefficients % 2 != 0)
    throw std::invalid_argument(
        "basis is \"" + basis +
        "\"; it must be \"fourier\", \"haar\", \"bspline\" or \"daubechiesN\" with an even "
        "number N of coefficients in 2..40");
  return coefficients;
}

bool is_wavelet(const std::string& basis) { return daubechies_coefficients(basis) > 0 || basis != "fourier"; }

}  // namespace wavebalance::app
