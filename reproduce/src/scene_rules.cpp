#include "scene_rules.hpp"

#include <bit>
#include <initializer_list>

#include "wavebalance/reproduce/compose.hpp"
#include "wavebalance/reproduce/scene_keys.hpp"
#include "wavebalance/reproduce/scene_loader.hpp"

namespace wavebalance::reproduce {
namespace {

constexpr int most_stepped_elements = 2000;  // dense matrices of twice that size

bool is_power_of_two(int value) { return value > 0 && std::has_single_bit(static_cast<unsigned>(value)); }

/// Blames the first of `names` that the scene holds.
[[noreturn]] void fail_rule(const Document& document, std::initializer_list<std::string_view> names,
                            const std::string& rule) {
  for (const auto name : names) {
    const SceneKey& key = *find_scene_key(name);
    if (const auto* entry = document.find(key.section, key.name)) fail_at(document, *entry, rule);
  }
  throw SceneError({document.name, 0, "", std::string(*names.begin()), "", rule});
}

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
}

void check_time(const Document& document, const Scene& scene) {
  const Time& time = scene.time;
  const std::string functions = std::to_string(time.functions);
  if (time.quadrature_points < time.functions)
    fail_rule(
        document, {"time.quadrature_points", "time.functions"},
        "fewer quadrature points than functions; expected quadrature_points >= functions = " + functions);
  check_wavelet_sizes(document, scene);
  const auto pair = pair_admissibility(time);
  if (!pair.admissible)
    fail_rule(document, {"time.trial", "time.weight"},
              "not an admissible trial basis for weight = \"" + time.weight + "\": " + pair.reason);
}

void check_sweep(const Document& document, const Analysis& analysis) {
  if (analysis.frequency_from == analysis.frequency_to)
    fail_rule(document, {"analysis.frequency_to"}, "expected another frequency than frequency_from");
  if (analysis.first_step > analysis.largest_step)
    fail_rule(document, {"analysis.first_step", "analysis.largest_step"},
              "expected first_step <= largest_step = " + toml_text(analysis.largest_step));
}

}  // namespace

void fail_at(const Document& document, const DocumentEntry& entry, std::string allowed) {
  throw SceneError(
      {document.name, entry.line, entry.override, entry.full_name(), entry.found, std::move(allowed)});
}

void check_scene_rules(const Document& document, const Scene& scene) {
  const AnalysisType type = scene.analysis.type;
  if (type != AnalysisType::time_stepping) check_time(document, scene);
  if (type == AnalysisType::frequency_sweep) check_sweep(document, scene.analysis);
  if (type == AnalysisType::time_stepping && scene.structure.elements > most_stepped_elements)
    fail_rule(document, {"structure.elements"},
              "expected at most " + std::to_string(most_stepped_elements) +
                  " for time stepping, whose matrices are dense");
}

}  // namespace wavebalance::reproduce
