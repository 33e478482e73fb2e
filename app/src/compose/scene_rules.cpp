#include "compose/compose_parts.hpp"

#include <bit>

#include "scene/keys/law_keys.hpp"
#include "scene/scene_keys_text.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

constexpr double least_tolerance = 1e-13;
constexpr int most_dense_unknowns = 2000;  // time stepping: dense matrices of twice that size; modes: of that

bool is_power_of_two(int value) { return value > 0 && std::has_single_bit(static_cast<unsigned>(value)); }

void check_wavelet_sizes(const Document& document, const Scene& scene) {
  const Time& time = scene.time;
  if (!is_wavelet(time.trial) && !is_wavelet(time.weight)) return;
  const std::string basis =
      "the wavelet basis \"" + (is_wavelet(time.trial) ? time.trial : time.weight) + "\"";
  if (!is_power_of_two(time.functions))
    fail_rule(document, {"time.functions"}, "expected a power of two for " + basis);
  if (!is_power_of_two(time.quadrature_points))
    fail_rule(document, {"time.quadrature_points"}, "expected a power of two for " + basis);
  if (is_wavelet(time.trial) && !is_power_of_two(scene.analysis.output_points))
    fail_rule(document, {"analysis.output_points"}, "expected a power of two for " + basis);
  if (is_wavelet(time.trial) && scene.analysis.motion_points > 0 &&
      !is_power_of_two(scene.analysis.motion_points))
    fail_rule(document, {"analysis.motion_points"}, "expected 0 or a power of two for " + basis);
}

void check_pair(const Document& document, const Time& time) {
  const auto pair = pair_admissibility(time);
  if (!pair.admissible)
    fail_rule(document, {"time.trial", "time.weight"},
              "not an admissible trial basis for weight = \"" + time.weight + "\": " + pair.reason);
}

/// Rounding keeps estimates of errors above about 1e-14.
void check_least_tolerance(const Document& document, const Scene& scene) {
  if (!(scene.time.tolerance >= least_tolerance))
    fail_rule(document, {"time.tolerance"}, "expected a number of at least 1e-13");
}

/// Values that a tolerance chooses must not be given.
void check_tolerance(const Document& document, const Scene& scene) {
  check_least_tolerance(document, scene);
  Time time = scene.time;
  if (time.functions != 0 || time.quadrature_points != 0)
    fail_rule(document, {"time.functions", "time.quadrature_points"},
              "not beside time.tolerance, which chooses it; expected one or the other");
  if (time.sample_offset != 0.0)
    fail_rule(document, {"time.sample_offset"},
              "not beside time.tolerance, whose levels share points at the left ends; expected 0");
  if (time.trial.empty() != time.weight.empty())
    fail_rule(document, {"time.trial", "time.weight"},
              "beside time.tolerance expected both time.trial and time.weight, or none of them");
  if (time.trial.empty()) return;
  time.functions = 16;  // no matter how many: exponents and derivatives decide
  time.quadrature_points = 4 * time.functions;
  check_pair(document, time);
  if (is_wavelet(time.trial) && !is_power_of_two(scene.analysis.output_points))
    fail_rule(document, {"analysis.output_points"},
              "expected a power of two for the wavelet basis \"" + time.trial + "\"");
}

void check_sample_offset(const Document& document, const Time& time) {
  if (time.sample_offset == 0.0) return;
  if (time.sample_offset != 0.5)
    fail_rule(document, {"time.sample_offset"}, "expected 0 or 0.5, left ends or middles of the intervals");
  if (time.nyquist == NyquistCoefficient::drop) return;
  try {
    make_pair(time);
  } catch (const std::invalid_argument& error) {
    fail_rule(document, {"time.sample_offset", "time.nyquist"}, error.what());
  }
}

/// Motions of several periods of the load: the load is one of the harmonics of the functions.
void check_subharmonic(const Document& document, const Scene& scene) {
  const int periods = scene.analysis.subharmonic;
  if (periods == 1) return;
  if (scene.time.tolerance > 0.0)
    fail_rule(document, {"analysis.subharmonic"},
              "not beside time.tolerance, which refines motions of one period; expected 1, or "
              "time.functions in place of the tolerance");
  if ((scene.time.functions - 1) / 2 < periods)
    fail_rule(document, {"analysis.subharmonic", "time.functions"},
              "the functions belong to " + std::to_string(periods) +
                  " periods of the load, which is their harmonic " + std::to_string(periods) +
                  "; expected subharmonic <= " + std::to_string((scene.time.functions - 1) / 2) +
                  ", or more time.functions");
}

/// Attractors and exact solutions require an equation in time and not too many modes.
void check_coexisting(const Document& document, const Scene& scene) {
  if (scene.analysis.type != AnalysisType::motions || solves_by_impacts(scene)) return;
  const int most = solvers::AttractorOptions{}.max_size, size = reduced_size(scene);
  if (scene.structure.loss_factor > 0.0)
    fail_rule(
        document, {"structure.loss_factor", "analysis.type"},
        "not with analysis.type = \"motions\", since a loss factor has no equation in time; expected 0, or "
        "modal_damping = loss_factor / 2 in its place");
  if (size > most)
    fail_rule(
        document, {"structure.kept_modes", "structure.elements", "analysis.type"},
        std::to_string(size) + " degrees of freedom; expected at most " + std::to_string(most) +
            " for analysis.type = \"motions\", which computes all modes; structure.kept_modes reduces them");
}

/// Motions on other curves are attractors of the structure.
void check_isolas(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  if (!analysis.isolas) return;
  const auto refuse = [&](bool given, const char* key, const std::string& why) {
    if (given) fail_rule(document, {"analysis.isolas", key}, why);
  };
  refuse(analysis.subharmonic > 1, "analysis.subharmonic",
         "not with motions of several periods of the load; expected analysis.subharmonic = 1");
  refuse(scene.structure.loss_factor > 0.0, "structure.loss_factor",
         "not with a loss factor, which has no equation in time to integrate; expected 0, or "
         "modal_damping = loss_factor / 2");
  refuse(scene.structure.matrices.free, "structure.free",
         "not with a free structure, for which time integration does not converge; expected "
         "analysis.isolas = false");
  refuse(is_rigid(scene.contact.law), "contact.law",
         "not with a rigid contact, which has no law of impact for time integration; expected "
         "false, or a stiff \"linear\" law");
  constexpr int most_frequencies = 100'000;
  if (std::abs(analysis.frequency_to - analysis.frequency_from) / analysis.isola_spacing > most_frequencies)
    fail_rule(document, {"analysis.isola_spacing"},
              "expected at most " + std::to_string(most_frequencies) + " frequencies in the interval");
  const int most = solvers::AttractorOptions{}.max_size, size = reduced_size(scene);
  refuse(size > most, "structure.kept_modes",
         std::to_string(size) + " degrees of freedom; expected at most " + std::to_string(most) +
             " for time integration, which requires all modes; structure.kept_modes reduces them");
}

/// Keys that an exact curve does not support or need.
void check_exact(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  if (!analysis.exact) return;
  const auto refuse = [&](bool given, const char* key) {
    if (given)
      fail_rule(document, {"analysis.exact", key},
                std::string("not with ") + key + "; expected analysis.exact = false, or no " + key);
  };
  refuse(analysis.branches, "analysis.branches");
  refuse(!analysis.motion_at.empty(), "analysis.motion_at");
  refuse(analysis.exact_near, "analysis.phases");
  if (!analysis.special_points)
    fail_rule(document, {"analysis.exact", "analysis.special_points"},
              "an exact curve always finds its bifurcation and grazing points; expected "
              "analysis.special_points = true");
  refuse(analysis.subharmonic > 1, "analysis.subharmonic");
  refuse(scene.structure.loss_factor > 0.0, "structure.loss_factor");
  if (is_rigid(scene.contact.law) && !moves_by_events(scene))
    fail_rule(
        document, {"analysis.exact", "contact.law"},
        "not with a rigid contact, whose beginnings and ends are not solved for along a curve; expected an "
        "elastic law, or analysis.exact = false");
}

/// Branches begin where multipliers pass the unit circle.
void check_branches(const Document& document, const Scene& scene) {
  if (!scene.analysis.branches) return;
  if (is_rigid(scene.contact.law) && !has_impacts(scene.contact))
    fail_rule(
        document, {"analysis.branches", "contact.law"},
        "not with contact.law = \"rigid\", whose perturbations have no finite stiffness; expected false, "
        "or a stiff \"linear\" law");
  if (!scene.analysis.stability)
    fail_rule(document, {"analysis.branches", "analysis.stability"},
              "not with analysis.stability = false, by which branches are found; expected false, or "
              "analysis.stability = true");
  if (!scene.analysis.special_points)
    fail_rule(document, {"analysis.branches", "analysis.special_points"},
              "not with analysis.special_points = false, at which branches begin; expected false, or "
              "analysis.special_points = true");
}

/// Motions of a sweep lie on its curve.
void check_motions(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const bool over_amplitude = analysis.type == AnalysisType::amplitude_sweep;
  const auto [from, to] = sweep_interval(analysis);
  const auto [low, high] = std::minmax(from, to);
  const auto load = reference_load(scene.forcing);
  const std::string unit = !over_amplitude ? " Hz"
                           : load          ? " " + std::string(load->unit)
                                           : "",
                    quantity = over_amplitude ? "an amplitude" : "a frequency";
  for (const double place : analysis.motion_at.places)
    if (place < low || place > high)
      fail_rule(document, {"analysis.motion_at"},
                toml_text(place) + unit + " is outside the sweep; expected " + quantity + " from " +
                    toml_text(low) + " to " + toml_text(high) + unit);
  if (analysis.motion_at.special && !analysis.stability)
    fail_rule(document, {"analysis.motion_at", "analysis.stability"},
              "\"special\" not with analysis.stability = false, which finds no bifurcation points; "
              "expected analysis.stability = true");
  if (analysis.motion_at.special && !analysis.special_points)
    fail_rule(
        document, {"analysis.motion_at", "analysis.special_points"},
        "\"special\" not with analysis.special_points = false; expected analysis.special_points = true");
  if (analysis.motion_points > 0 && analysis.motion_at.empty())
    fail_rule(document, {"analysis.motion_points", "analysis.type"},
              "a sweep writes no motion without analysis.motion_at; expected 0, or motion_at = \"peak\"");
}

void check_dense_size(const Document& document, const Scene& scene) {
  const bool stepping = integrates_in_time(scene.analysis.type);
  const bool mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  const bool damped = scene.structure.modal_damping > 0.0;
  if ((!stepping && !mode && !damped) || reduced_size(scene) <= most_dense_unknowns) return;
  const std::string most = "expected at most " + std::to_string(most_dense_unknowns) + " ";
  const std::string why = mode       ? "for a nonlinear mode, which requires all linear modes"
                          : stepping ? "for time stepping, whose matrices are dense"
                                     : "for modal damping, which requires all linear modes";
  if (scene.structure.type == StructureType::bar) fail_rule(document, {"structure.elements"}, most + why);
  const std::string advice = "; structure.kept_modes reduces them";
  const std::string count = std::to_string(reduced_size(scene)) + " degrees of freedom; ";
  fail_rule(document, {"structure.kept_modes", "structure.stiffness"}, count + most + why + advice);
}

/// Impacts require contacts with mass in an equation in time, without basis functions.
void check_impacts(const Document& document, const Scene& scene) {
  const auto refuse = [&](bool given, const char* key, const std::string& why) {
    if (given) fail_rule(document, {key, "contact.restitution"}, why);
  };
  refuse(
      scene.contact.mass == ContactMass::redistribute, "contact.mass",
      "a contact without mass has no impacts, but contact.restitution is given; expected one or the other");
  refuse(scene.structure.massless_tip, "structure.massless_tip",
         "a contact without mass has no impacts; expected false, or no contact.restitution");
  refuse(scene.structure.loss_factor > 0.0, "structure.loss_factor",
         "not with contact.restitution, since a loss factor has no equation in time; expected 0, or damping");
  refuse(
      scene.analysis.type == AnalysisType::nonlinear_mode, "analysis.type",
      "not with contact.restitution: impacts dissipate energy of a free motion; expected another analysis");
  refuse(scene.analysis.exact && !moves_by_events(scene), "analysis.exact",
         "not with contact.restitution, with which curves are exact as they are; expected false");
  refuse(!scene.analysis.motion_at.empty(), "analysis.motion_at",
         "not with contact.restitution; expected none, or analysis.type = \"forced_response\" at one place");
}

void check_rigid(const Document& document, const Scene& scene) {
  if (!is_rigid(scene.contact.law)) return;
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i)
    if (scene.contact.pairs[i].values.contains("restitution") && !has_impacts(scene.contact))
      fail_rule(
          document, {pair_section(i) + ".restitution", "contact.restitution"},
          "where one contact has impacts, all have; expected contact.restitution, which holds for pairs "
          "without one of their own");
  if (has_impacts(scene.contact)) return check_impacts(document, scene);
  const bool balanced =
      !integrates_in_time(scene.analysis.type) && scene.analysis.type != AnalysisType::nonlinear_mode;
  if (balanced && scene.contact.mass == ContactMass::keep && !scene.structure.massless_tip)
    fail_rule(
        document, {"contact.mass"},
        "not with contact.law = \"rigid\": a continuum of motions satisfies a rigid obstacle and a contact "
        "with mass without a law of impact; expected \"redistribute\", contact.restitution, or a stiff \"linear\" "
        "law");
  if (balanced && scene.contact.form == ContactForm::displacement)
    fail_rule(document, {"contact.form"},
              "not with contact.law = \"rigid\", whose force is no function of the displacement; expected "
              "\"automatic\" or \"force\"");
  if (integrates_in_time(scene.analysis.type))
    fail_rule(
        document, {"contact.law", "analysis.type"},
        "not with time stepping: at a rigid obstacle the motion of a structure cut into elements goes "
        "on only with a law of impact, which the scene does not have; expected contact.restitution, a stiff "
        "\"linear\" law, or analysis.type = \"forced_response\"");
}

/// Each number may be in range and their products not.
void check_products(const Document& document, const Scene& scene) {
  const Structure& bar = scene.structure;
  const auto check = [&](double value, std::initializer_list<std::string_view> names,
                         const std::string& what) {
    if (!(value >= 1e-300 && value <= 1e300))
      fail_rule(document, names, what + " is " + toml_text(value) + "; expected a product in 1e-300..1e300");
  };
  const double size = bar.length / bar.elements;
  const double stiffness = bar.youngs_modulus * bar.area / size;
  check(stiffness, {"structure.area", "structure.youngs_modulus"},
        "the stiffness of an element, youngs_modulus x area x elements / length");
  check(bar.density * bar.area * size, {"structure.area", "structure.density"},
        "the mass of an element, density x area x length / elements");
  if (scene.forcing.amplitude != 0.0)
    check(std::abs(scene.forcing.amplitude) * bar.length / (bar.youngs_modulus * bar.area),
          {"forcing.amplitude"},
          "the static displacement of the tip, amplitude x length / (youngs_modulus x area)");
}

/// The pair of a curve of exact motions whose scene names none: of the balance that it starts from.
Time start_pair(const Scene& scene) {
  int functions = 63;
  for (const ForcingTerm& term : scene.forcing.terms)
    if (term.samples.empty()) functions = std::max(functions, 2 * term.harmonic + 1);
  Time time = scene.time;
  time.trial = time.weight = "fourier";
  time.functions = functions;
  time.quadrature_points = 4 * (functions + 1);
  return time;
}

}  // namespace

void check_time(const Document& document, const Scene& scene) {
  const Time& time = scene.time;
  if (time.tolerance > 0.0) return check_tolerance(document, scene);
  const std::string functions = std::to_string(time.functions);
  if (time.quadrature_points < time.functions)
    fail_rule(
        document, {"time.quadrature_points", "time.functions"},
        "fewer quadrature points than functions; expected quadrature_points >= functions = " + functions);
  check_wavelet_sizes(document, scene);
  check_pair(document, time);
  check_sample_offset(document, time);
}

void check_scene_rules(const Document& document, Scene& scene) {
  check_structure_rules(document, scene);
  check_laws(document, scene);
  const AnalysisType type = scene.analysis.type;
  const bool stepping = integrates_in_time(type), mode = type == AnalysisType::nonlinear_mode;
  const bool sweep = is_sweep(type);
  const bool events = moves_by_events(scene), exact = solves_exactly(scene);
  const bool balanced = !stepping && !mode && !exact && !events && !solves_by_impacts(scene);
  if (sweep && events) scene.analysis.exact = true;
  // The pair of the start names bases, by which an automatic mass would be redistributed.
  if (events && scene.contact.mass == ContactMass::automatic) scene.contact.mass = ContactMass::keep;
  if (sweep && scene.analysis.exact && scene.time.trial.empty()) scene.time = start_pair(scene);
  if (exact && (!events || scene.time.tolerance > 0.0)) check_least_tolerance(document, scene);
  if (balanced) check_time(document, scene);
  if (mode) check_mode(document, scene);
  if (!mode && !kind_of(type).under_load) check_without_load(document, scene);
  check_rigid(document, scene);
  if (scene.structure.type == StructureType::bar) check_products(document, scene);
  if (sweep) check_sweep(document, scene);
  if (sweep) check_motions(document, scene);
  check_records(document, scene);
  if (!mode) check_loads(document, scene);
  if (balanced) check_subharmonic(document, scene);
  check_outputs(document, scene);
  check_branches(document, scene);
  check_exact(document, scene);
  check_isolas(document, scene);
  check_coexisting(document, scene);
  check_dense_size(document, scene);
}

}  // namespace wavebalance::app
