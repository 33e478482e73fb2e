// Rules between the keys of a nonlinear mode.
#include "compose/compose_parts.hpp"
#include "scene/keys/law_keys.hpp"
#include "scene/scene_keys_text.hpp"
#include "scene/scene_reader.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// Limits of the number of linear modes.
std::string size_text(const Scene& scene) {
  const int size = reduced_size(scene);
  if (scene.structure.type == StructureType::bar) return "structure.elements = " + std::to_string(size);
  return "the structure's degrees of freedom" +
         std::string(scene.structure.kept_modes < 0 ? "" : " once reduced");
}

/// The pair of bases of an elastic or damped mode, or the samples of its harmonics where the scene names
/// none.
void check_mode_pair(const Document& document, const Scene& scene, bool damped) {
  if (scene.time.trial.empty() != scene.time.weight.empty())
    fail_rule(document, {"time.trial", "time.weight"}, "expected both time.trial and time.weight, or none");
  const Analysis& analysis = scene.analysis;
  if (scene.time.trial.empty()) {
    if (scene.time.functions != 0 || scene.time.quadrature_points != 0)
      fail_rule(document, {"time.functions", "time.quadrature_points"},
                "not without time.trial and time.weight; expected both of these, or analysis.harmonics and "
                "analysis.samples");
    if (analysis.samples <= 2 * analysis.harmonics)
      fail_rule(document, {"analysis.samples", "analysis.harmonics"},
                "expected samples > 2 x harmonics = " + std::to_string(2 * analysis.harmonics));
    return;
  }
  if (scene.time.functions < 3)
    fail_rule(document, {"time.functions", "time.trial"},
              "expected at least 3 time.functions beside time.trial");
  check_time(document, scene);
  if (analysis.cosine_only && (is_wavelet(scene.time.trial) || is_wavelet(scene.time.weight)))
    fail_rule(document, {"analysis.cosine_only"}, "expected false for wavelets, which have no even motions");
  if (damped) return;
  try {
    solvers::require_free_motions(make_pair(scene.time));
  } catch (const std::invalid_argument& error) {
    fail_rule(document, {"time.trial", "time.weight"}, error.what());
  }
}

/// The lengths that energies refer to.
void check_lengths_of_mode(const Document& document, const Scene& scene) {
  const double length = scene.analysis.reference_length;
  bool gaps_alone = true;
  for (const SceneContact& contact : contacts_of(scene)) {
    gaps_alone = gaps_alone && has_gap(contact.law);
    if (has_gap(contact.law) && !(contact.gap > 0.0))
      fail_rule(document,
                {contact.pair ? pair_section(*contact.pair) + ".gap" : "contact.gap", "contact.gap"},
                "expected a number in m, > 0 for a nonlinear mode");
    if (!has_gap(contact.law) && !(length > 0.0))
      fail_rule(document, {"analysis.reference_length", "contact.law"},
                "the law \"" + contact.law +
                    "\" has no gap; expected a number in m, > 0, the displacement that energies refer to");
  }
  if (gaps_alone && length > 0.0)
    fail_rule(document, {"analysis.reference_length"},
              "all laws have gaps, which energies refer to; expected none");
}

/// A mode with friction or dampers: its curve is one over the amplitude.
void check_damped_mode(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const Analysis usual;
  const auto refuse = [&](bool given, const char* key, const std::string& what) {
    if (given) fail_rule(document, {key, "contact.law"}, "not with friction or dampers, " + what);
  };
  const std::string ends =
      "of which the curve is one over the amplitude; expected none, or largest_amplitude";
  refuse(analysis.cosine_only, "analysis.cosine_only",
         "with which motions are not even in time; expected false");
  refuse(analysis.energy_ratio > 0.0, "analysis.energy_ratio",
         "whose motions are told by amplitude; expected 0, or amplitude_ratio");
  refuse(analysis.largest_energy != usual.largest_energy, "analysis.largest_energy", ends);
  refuse(analysis.last_frequency_ratio != usual.last_frequency_ratio, "analysis.last_frequency_ratio", ends);
  check_mode_pair(document, scene, true);
}

/// The motions of a mode of rigid contacts with mass are Fourier series with analysis.harmonics.
void check_no_bases(const Document& document, const Scene& scene) {
  const Scene usual;
  for (const SceneKey& key : scene_keys()) {
    if (key.section != "time" || key.get(scene) == key.get(usual)) continue;
    const DocumentEntry* entry = document.find("time", key.name);
    if (entry == nullptr || is_of_former_analysis(document, *entry)) continue;
    fail_at(
        document, *entry,
        "does not belong to a nonlinear mode of rigid contacts with mass, which is a Fourier series; expected "
        "none, or analysis.harmonics");
  }
}

}  // namespace

void check_mode(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const bool damped = is_damped_mode(scene);
  const auto refuse = [&](bool given, const char* key) {
    if (given)
      fail_rule(
          document, {key, "contact.law"},
          "the motions of a mode without friction and dampers are told by energy; expected none, or analysis.energy_ratio");
  };
  refuse(!damped && analysis.amplitude_ratio > 0.0, "analysis.amplitude_ratio");
  refuse(!damped && analysis.largest_amplitude != Analysis().largest_amplitude, "analysis.largest_amplitude");
  if (scene.contact.law == no_law)
    fail_rule(document, {"contact.law"},
              "expected " + alternatives(laws_of_modes()) + " for a nonlinear mode");
  if (!damped) check_lengths_of_mode(document, scene);
  if (analysis.mode > reduced_size(scene))
    fail_rule(document, {"analysis.mode"},
              "expected at most " + std::to_string(reduced_size(scene)) + ", " + size_text(scene));
  constexpr double least_ratio = 1.001;
  if (analysis.last_frequency_ratio > 0.0 && analysis.last_frequency_ratio <= least_ratio)
    fail_rule(document, {"analysis.last_frequency_ratio"}, "expected 0 for none, or a number above 1.001");
  if (analysis.samples < 2 * analysis.harmonics)
    fail_rule(document, {"analysis.samples", "analysis.harmonics"},
              "expected samples >= 2 x harmonics = " + std::to_string(2 * analysis.harmonics));
  if (damped) check_damped_mode(document, scene);
  if (is_elastic_mode(scene)) check_mode_pair(document, scene, false);
  if (!damped && !is_elastic_mode(scene)) check_no_bases(document, scene);
}

void check_without_load(const Document& document, const Scene& scene) {
  const std::string not_with = "not with analysis.type = \"" + name_of(scene.analysis.type) + "\"",
                    none = not_with + ", a motion without periodic load; expected ";
  if (scene.forcing.amplitude != 0.0)
    fail_rule(document, {"forcing.amplitude", "analysis.type"}, none + "0 or none");
  if (scene.forcing.frequency != 0.0)
    fail_rule(document, {"forcing.frequency", "analysis.type"},
              not_with + ", whose frequency is found; expected none");
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i) {
    const ForcingTerm& term = scene.forcing.terms[i];
    if (!term.samples.empty() || term.harmonic != 0)
      fail_rule(document,
                {term_section(i) + (term.samples.empty() ? ".harmonic" : ".samples"),
                 term_section(i) + ".amplitude", term_section(i) + ".amplitude_table", "analysis.type"},
                none + "harmonic = 0, a static load");
  }
  const MatricesStructure& matrices = scene.structure.matrices;
  if ((!matrices.gyroscopic.empty() || !matrices.spin_stiffness.empty()) && matrices.spin_speed == 0.0)
    fail_rule(
        document, {"structure.spin_speed", "structure.gyroscopic", "structure.spin_stiffness"},
        "turns with the load, which a limit cycle does not have; expected structure.spin_speed in rad/s");
  if (scene.structure.loss_factor > 0.0)
    fail_rule(
        document, {"structure.loss_factor", "analysis.type"},
        not_with +
            ", since a loss factor has no equation in time; expected 0, or modal_damping = loss_factor / 2 in its place");
  if (is_rigid(scene.contact.law) && !has_impacts(scene.contact))
    fail_rule(
        document, {"contact.law", "analysis.type"},
        not_with +
            ": a rigid obstacle needs a law of impact; expected contact.restitution, or a stiff \"linear\" law");
}

}  // namespace wavebalance::app
