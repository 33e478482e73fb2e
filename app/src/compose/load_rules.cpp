#include "compose/compose_parts.hpp"
#include "matrices/loads.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// The amplitude of [forcing] by a table.
void check_table_of_force(const Document& document, const Scene& scene) {
  const Forcing& forcing = scene.forcing;
  if (forcing.amplitude_table.empty()) return;
  const std::initializer_list<std::string_view> keys{"forcing.amplitude_table"};
  const AnalysisType type = scene.analysis.type;
  if (forcing.amplitude == 0.0)
    fail_rule(document, keys, "holds factors on forcing.amplitude, which is 0; expected a number beside it");
  if (is_over_amplitude(scene.analysis) || type == AnalysisType::limit_cycle)
    fail_rule(document, keys, "not with analysis.type = \"" + name_of(type) + "\"; expected amplitude alone");
  try {
    check_amplitude_table(scene, forcing.amplitude_table);
  } catch (const SamplesFault& fault) {
    fail_rule(document, keys, fault.what());
  }
}

}  // namespace

void check_loads(const Document& document, const Scene& scene) {
  const bool exact = solves_exactly(scene) || solves_by_impacts(scene) || moves_by_events(scene);
  const bool balanced = !integrates_in_time(scene.analysis.type) && (exact || scene.time.tolerance == 0.0);
  const int functions = exact ? exact_starts.back() : scene.time.functions;
  const int most = (functions - 1) / 2 / scene.analysis.subharmonic;
  for (const SceneContact& contact : contacts_of(scene))
    if (balanced && is_signal(contact) &&
        std::ssize(contact::list_of(contact.values, "stiffness_harmonics")) > most)
      fail_rule(document,
                {pair_section(*contact.pair) + ".stiffness_harmonics", "contact.stiffness_harmonics",
                 "time.functions"},
                "the functions hold harmonics of the load up to " + std::to_string(most) +
                    "; expected no more" + (exact ? "" : ", or more time.functions"));
  check_table_of_force(document, scene);
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i) {
    const ForcingTerm& term = scene.forcing.terms[i];
    if (balanced && term.samples.empty() && term.harmonic > most)
      fail_rule(document, {term_section(i) + ".harmonic", "time.functions"},
                "the functions hold harmonics of the load up to " + std::to_string(most) +
                    "; expected no more" + (exact ? "" : ", or more time.functions"));
    if (!term.amplitude_table.empty() && is_over_amplitude(scene.analysis))
      fail_rule(document, {term_section(i) + ".amplitude_table"},
                "not over the amplitude; expected amplitude alone");
    try {
      harmonics_of(term);
      check_amplitude_table(scene, term.amplitude_table);
    } catch (const SamplesFault& fault) {
      const char* file = term.samples.empty() ? ".amplitude_table" : ".samples";
      fail_rule(document, {term_section(i) + file}, fault.what());
    }
  }
}

}  // namespace wavebalance::app
