#include "compose/compose_parts.hpp"
#include "scene/scene_document.hpp"
#include "scene/scene_reader.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

void check_sweep(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const bool over_amplitude = is_over_amplitude(analysis);
  if (over_amplitude && !reference_load(scene.forcing))
    fail_rule(document, {"forcing.amplitude"},
              "there is no load to vary; expected another number than 0, or [[forcing.terms]] that are not "
              "static");
  if (!over_amplitude && analysis.frequency_from == analysis.frequency_to)
    fail_rule(document, {"analysis.frequency_to"}, "expected another frequency than frequency_from");
  if (over_amplitude && analysis.amplitude_from == analysis.amplitude_to)
    fail_rule(document, {"analysis.amplitude_to"}, "expected another amplitude than amplitude_from");
  if (is_sweep(analysis.type) && analysis.first_step > analysis.largest_step)
    fail_rule(document, {"analysis.first_step", "analysis.largest_step"},
              "expected first_step <= largest_step = " + toml_text(analysis.largest_step));
}

/// A diagram has one interval, and a record is long enough for its batches.
void check_records(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const bool diagram = analysis.type == AnalysisType::bifurcation_diagram;
  const int recorded = analysis.recorded_periods;
  if (!diagram && recorded > 0 && recorded < least_recorded_periods)
    fail_rule(document, {"analysis.recorded_periods"},
              "expected 0, or at least " + std::to_string(least_recorded_periods) +
                  ", of which statistics take batches");
  if (!diagram) return;
  const bool over_frequency = analysis.frequency_from + analysis.frequency_to > 0.0,
             over_amplitude = analysis.amplitude_from + analysis.amplitude_to > 0.0;
  if (over_frequency && over_amplitude)
    fail_rule(document, {"analysis.amplitude_from", "analysis.amplitude_to"},
              "the frequency has an interval, too; expected one interval");
  const auto require = [&](double value, const char* key) {
    if (!(value > 0.0))
      fail_missing(document, "analysis", key,
                   "one interval, analysis.frequency_from and frequency_to or analysis.amplitude_from and "
                   "amplitude_to");
  };
  require(over_amplitude ? analysis.amplitude_from : analysis.frequency_from,
          over_amplitude ? "amplitude_from" : "frequency_from");
  require(over_amplitude ? analysis.amplitude_to : analysis.frequency_to,
          over_amplitude ? "amplitude_to" : "frequency_to");
  if (over_amplitude && !(scene.forcing.frequency > 0.0))
    fail_missing(document, "forcing", "frequency", "a number in Hz, > 0, in a diagram over the amplitude");
  check_sweep(document, scene);
}

}  // namespace wavebalance::app
