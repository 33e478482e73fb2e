#include "results/record_parts.hpp"

#include "files/missing.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

/// Half the peak-to-peak value of an output at each row, not numbers off the mode: points on an internal
/// resonance are its own only where a curve that is complete ends on one.
std::vector<double> vibrations(const ModeOutputs& outputs, std::size_t output, const Record& record) {
  const std::vector<std::string> statuses = record.backbone.texts("status");
  std::vector<double> values(statuses.size(), missing);
  const bool resonant = record.converged && !statuses.empty() && statuses.back() == "tongue";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool on_mode =
        statuses[i] == "converged" || statuses[i] == "linear" || (resonant && statuses[i] == "tongue");
    if (on_mode && !outputs.points[i].empty()) values[i] = outputs.points[i][output].half_peak_to_peak();
  }
  return values;
}

/// The row with the largest of the values; none where all are missing.
std::optional<std::size_t> row_of_largest(const std::vector<double>& values) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && (!best || values[i] > values[*best])) best = i;
  return best;
}

/// The vibration where contacts begin to act: of a damped mode from its first point, up to which it is
/// linear, otherwise at the last linear point.
double vibration_at_onset(const Table& backbone, const std::vector<double>& vibration) {
  if (backbone.has_column("amplitude_ratio")) {
    const double first = vibration.empty() ? missing : backbone.numbers("amplitude_ratio").front();
    return first < 1.0 ? vibration.front() / first : missing;
  }
  const std::vector<std::string> statuses = backbone.texts("status");
  double value = missing;
  for (std::size_t i = 0; i < vibration.size() && statuses[i] == "linear"; ++i) value = vibration[i];
  return value;
}

/// Data of an output along a mode.
struct AlongMode {
  OutputMeasures most = {};  ///< where it vibrates most
  double frequency = missing, at_onset = missing, at_largest_damping = missing;
};

AlongMode along_mode(const ModeOutputs& outputs, std::size_t output, const Record& record) {
  AlongMode found;
  const Table& backbone = record.backbone;
  const std::vector<double> vibration = vibrations(outputs, output, record);
  found.at_onset = vibration_at_onset(backbone, vibration);
  if (const auto row = row_of_largest(vibration)) {
    found.most = outputs.points[*row][output];
    found.frequency = backbone.numbers("frequency_Hz")[*row];
  }
  if (!backbone.has_column("damping_ratio")) return found;
  if (const auto row = row_of_largest(backbone.numbers("damping_ratio")))
    found.at_largest_damping = vibration[*row];
  return found;
}

}  // namespace

std::vector<ModeOutput> append_outputs(Record& record, const Scene& scene, const ModeOutputs& outputs) {
  std::vector<ModeOutput> drawn;
  if (outputs.empty()) return drawn;
  const bool damped = record.backbone.has_column("damping_ratio");
  std::vector<Summary> table;
  Summary entries;
  for (std::size_t k = 0; k < outputs.outputs.size(); ++k) {
    const Output& output = outputs.outputs[k];
    const AlongMode found = along_mode(outputs, k, record);
    const double vibration = found.most.half_peak_to_peak();
    Summary& row = table.emplace_back(Summary{{"output", output.name},
                                              {"unit", output.unit},
                                              {"half_peak_to_peak", vibration},
                                              {"max", found.most.max},
                                              {"min", found.most.min},
                                              {"mean", found.most.mean},
                                              {"at_frequency_Hz", found.frequency},
                                              {"at_onset", found.at_onset}});
    if (damped) row.emplace_back("at_largest_damping", found.at_largest_damping);
    drawn.push_back({output, found.at_onset});
    if (k >= scene.analysis.outputs.size()) continue;
    entries.emplace_back(output.column_of("half_peak_to_peak"), vibration);
    entries.emplace_back(output.column + "_peak_frequency_Hz", found.frequency);
    entries.emplace_back(output.column_of("at_onset"), found.at_onset);
    if (damped) entries.emplace_back(output.column_of("at_largest_damping"), found.at_largest_damping);
  }
  std::vector<const MeasuredPoint*> rows;
  for (const MeasuredPoint& point : outputs.points) rows.push_back(&point);
  record.backbone = with_outputs(record.backbone, outputs.outputs, rows, scene.analysis.output_harmonics);
  insert_outputs(record.summary, scene, outputs.outputs, std::move(entries));
  record.add(quantities::outputs, table_of(table));
  record.interrupted = record.interrupted || outputs.cancelled;
  return drawn;
}

const ModeOutput* leading_of(const std::vector<ModeOutput>& outputs, const Scene& scene) {
  std::vector<Output> all;
  for (const ModeOutput& one : outputs) all.push_back(one.output);
  const auto leading = leading_output(all, scene);
  return leading ? &outputs[*leading] : nullptr;
}

void draw_outputs(Record& record, const Scene& scene, const std::vector<ModeOutput>& outputs,
                  const solvers::BackboneStability& stability) {
  const bool drawn_already = outputs.size() == 1 && leading_of(outputs, scene) != nullptr;
  if (outputs.empty() || drawn_already) return;
  Figure figure = outputs_figure(scene, record.backbone, outputs);
  draw_stability(figure, record.backbone, stability);
  record.output_pictures.push_back({"outputs", std::move(figure),
                                    record.backbone.has_column("damping_ratio")
                                        ? "frequency and damping over the vibration of each output"
                                        : "frequency over the vibration of each output"});
}

}  // namespace wavebalance::app
