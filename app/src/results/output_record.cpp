#include "results/record_parts.hpp"

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "plot/plot_parts.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::app {
namespace {

/// The measured points in the order of the rows of a sweep's table.
std::vector<const MeasuredPoint*> in_rows(const SweepOutputs& outputs, bool with_branches) {
  std::vector<const MeasuredPoint*> points;
  const auto append = [&](const std::vector<MeasuredPoint>& curve) {
    for (const MeasuredPoint& point : curve) points.push_back(&point);
  };
  for (std::size_t i = 0; i < outputs.curves.size(); ++i)
    if (i == 0 || with_branches) append(outputs.curves[i]);
  for (const auto& isola : outputs.isolas) append(isola);
  return points;
}

double relative_error(double value, double exact) { return std::abs(value - exact) / std::abs(exact); }

/// An output along a curve, from its points and the solutions between them.
struct PeakRow {
  double place = missing;
  OutputMeasures measures = {};
  PeakResolution resolution{missing, missing};
};

PeakRow sampled_peak(const std::vector<double>& places, const std::vector<MeasuredPoint>& curve,
                     std::size_t output) {
  PeakRow row;
  std::size_t peak = 0;
  std::vector<double> values(places.size(), missing);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve[k].empty()) continue;
    values[k] = curve[k][output].half_peak_to_peak();
    if (values[k] <= row.measures.half_peak_to_peak()) continue;
    row.measures = curve[k][output];
    peak = k;
  }
  if (!std::isfinite(row.measures.max)) return row;
  row.place = places[peak];
  row.resolution = peak_resolution(places, values, peak);
  return row;
}

/// Solutions between the points of a curve.
PeakRow solved_peak(const OutputPeak& peak) {
  PeakRow row{peak.at.value, peak.measures, {peak.at.height_error, peak.at.value_error}};
  row.measures.max = peak.measures.highest;
  row.measures.min = peak.measures.lowest;
  return row;
}

/// Digits of a value with this relative error; none where that is not known.
double digits_of_error(double error) {
  constexpr double most = 9.0;
  if (!std::isfinite(error)) return missing;
  return error > 0.0 ? std::clamp(std::floor(-std::log10(2.0 * error)), 0.0, most) : most;
}

/// The row of each output, with the error of its vibration at the peak of the curve where the exact motion is
/// known there: where it vibrates most and how well that is resolved, and of analysis.outputs, for which both
/// are solved for, where its modulus is largest, and how many digits of it are true.
Table peaks_table(const Sweep& sweep, const SweepOutputs& outputs) {
  const std::string place = sweep_axis(sweep).column();
  std::vector<Summary> rows;
  std::vector<double> places;
  for (const solvers::SweepPoint& point : sweep.curve.points)
    places.push_back(parameter_of(point, sweep.curve.parameter));
  const MeasuredPoint& at_peak = outputs.curves[0][peak_of(sweep.curve)];
  for (std::size_t i = 0; i < outputs.outputs.size(); ++i) {
    const Output& output = outputs.outputs[i];
    const bool here = i < outputs.peaks.size() && outputs.peaks[i].solved;
    const PeakRow row = here ? solved_peak(outputs.peaks[i]) : sampled_peak(places, outputs.curves[0], i);
    const bool exact = !outputs.exact_at_peak.empty() && !at_peak.empty();
    const double height = here ? outputs.peaks[i].at.height : row.measures.half_peak_to_peak();
    const double error =
        exact ? relative_error(at_peak[i].half_peak_to_peak(), outputs.exact_at_peak[i].half_peak_to_peak())
              : missing;
    Summary& cells = rows.emplace_back(Summary{{"output", output.name},
                                               {"unit", output.unit},
                                               {place, row.place},
                                               {"half_peak_to_peak", height},
                                               {"max", row.measures.max},
                                               {"min", row.measures.min},
                                               {"mean", row.measures.mean},
                                               {quantities::peak_value_resolution, row.resolution.value},
                                               {quantities::peak_place_resolution, row.resolution.place},
                                               {"error_at_peak", error}});
    if (outputs.peaks.empty()) continue;
    const bool also = i < outputs.largest.size();
    cells.emplace_back("digits", here ? digits_of_error(std::fmax(row.resolution.value, error)) : missing);
    cells.emplace_back("largest", also ? outputs.largest[i].at.height : missing);
    cells.emplace_back("largest_" + place, also ? outputs.largest[i].at.value : missing);
  }
  return table_of(rows);
}

/// One row for each output, with the names of columns that columns_of() has, but for the output's own name,
/// and the error of its vibration against the exact motion, empty where that is not known.
Table measures_table(const std::vector<Output>& outputs, const MeasuredPoint& measured,
                     const MeasuredPoint& exact, int harmonics) {
  std::vector<std::string> columns{"output",
                                   "unit",
                                   "max",
                                   "min",
                                   "half_peak_to_peak",
                                   "rms",
                                   "mean",
                                   quantities::error_of_vibration.column()};
  for (int n = 1; n <= harmonics; ++n) {
    columns.push_back(fmt::format("amplitude_{}", n));
    columns.push_back(fmt::format("phase_{}_degrees", n));
  }
  columns.insert(columns.end(),
                 {quantities::max_contact_force.column(), quantities::contact_fraction.column()});
  Table table(columns);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    std::vector<Cell> row{outputs[i].name, outputs[i].unit};
    for (const double cell : cells_of(outputs[i], measured[i], harmonics)) row.emplace_back(cell);
    row.insert(row.begin() + 7,
               exact.empty() ? missing
                             : relative_error(measured[i].half_peak_to_peak(), exact[i].half_peak_to_peak()));
    while (row.size() < columns.size()) row.emplace_back(missing);
    table.append_row(std::move(row));
  }
  return table;
}

/// Each of analysis.outputs along a curve.
Summary curve_entries(const Sweep& sweep, const SweepOutputs& outputs, const Table& peaks,
                      std::size_t count) {
  const std::string place = sweep_axis(sweep).column();
  const auto number = [&](std::size_t row, std::string_view column) { return peaks.numbers(column)[row]; };
  Summary entries;
  for (std::size_t i = 0; i < count; ++i) {
    const Output& output = outputs.outputs[i];
    entries.emplace_back(output.column_of("half_peak_to_peak"), number(i, "half_peak_to_peak"));
    entries.emplace_back(output.column + "_peak_" + place, number(i, place));
    if (outputs.peaks.empty()) continue;
    entries.emplace_back(output.column + "_peak_digits", number(i, "digits"));
    entries.emplace_back(output.column_of("largest"), number(i, "largest"));
    entries.emplace_back(output.column + "_largest_" + place, number(i, "largest_" + place));
  }
  return entries;
}

/// Each of analysis.outputs in a motion.
Summary motion_entries(const std::vector<Output>& outputs, const MeasuredPoint& measured, std::size_t count,
                       int harmonics) {
  Summary entries;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<std::string> columns = columns_of(outputs[i], std::min(harmonics, 1));
    const std::vector<double> cells = cells_of(outputs[i], measured[i], std::min(harmonics, 1));
    for (std::size_t k = 0; k < columns.size(); ++k) entries.emplace_back(columns[k], cells[k]);
  }
  return entries;
}

}  // namespace

Table with_outputs(const Table& table, const std::vector<Output>& outputs,
                   const std::vector<const MeasuredPoint*>& points, int harmonics) {
  std::vector<std::string> columns = table.columns();
  for (const Output& output : outputs)
    for (std::string& column : columns_of(output, harmonics)) columns.push_back(std::move(column));
  Table wide(columns);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<Cell> cells = table.row(row);
    const MeasuredPoint* point = row < points.size() ? points[row] : nullptr;
    const bool known = point != nullptr && !point->empty();
    for (std::size_t i = 0; i < outputs.size(); ++i)
      for (const double cell : cells_of(outputs[i], known ? (*point)[i] : OutputMeasures(), harmonics))
        cells.emplace_back(cell);
    wide.append_row(std::move(cells));
  }
  return wide;
}

void insert_outputs(Summary& summary, const Scene& scene, const std::vector<Output>& outputs,
                    Summary entries) {
  for (Entry& one : entries) one.kind = EntryKind::result;
  if (const auto leading = leading_output(outputs, scene))
    entries.emplace(entries.begin(), quantities::leading_output, outputs[*leading].name);
  const auto status = std::ranges::find(summary, quantities::status.name, &Entry::name);
  summary.insert(status == summary.end() ? status : status + 1, entries.begin(), entries.end());
}

void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs) {
  if (outputs.empty()) return;
  record.sweep = with_outputs(record.sweep, outputs.outputs, in_rows(outputs, scene.analysis.branches),
                              scene.analysis.output_harmonics);
  const Table peaks = peaks_table(sweep, outputs);
  insert_outputs(record.summary, scene, outputs.outputs,
                 curve_entries(sweep, outputs, peaks, scene.analysis.outputs.size()));
  record.add(quantities::outputs, peaks);
  if (sweep.curve.points.empty()) return;
  Figure figure = outputs_figure(sweep, outputs, contact_places(scene));
  if (scene.plot.log) take_logarithmic_ordinates(figure);
  record.output_pictures.push_back(
      {"outputs", std::move(figure), "the vibration of each output along the curve"});
}

void append_outputs(Record& record, const Scene& scene, const StructureModel& model, const Response& response,
                    const LoadAt& load) {
  const std::vector<Output> outputs = outputs_of(scene);
  if (outputs.empty() || !response.moves || response.recorded || response.contacts.empty()) return;
  const Eigen::MatrixXd motion =
      values_of_outputs(outputs, scene, model, response.contacts, response.structure, load);
  const int harmonics = scene.analysis.output_harmonics;
  const Eigen::MatrixXd force = response.forces_are_known() ? response.contacts.force : Eigen::MatrixXd();
  record.outputs.add_column("time_fraction", time_fractions(int(motion.cols())));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    record.outputs.add_column(outputs[i].column + (outputs[i].suffix.empty() ? "" : "_" + outputs[i].suffix),
                              Eigen::VectorXd(motion.row(Eigen::Index(i)).transpose()));
  const MeasuredPoint measured = measure(outputs, motion, force, harmonics, response.periods);
  insert_outputs(record.summary, scene, outputs,
                 motion_entries(outputs, measured, scene.analysis.outputs.size(), harmonics));
  record.add(quantities::outputs,
             measures_table(outputs, measured, exact_outputs(scene, model, response, outputs), harmonics));
  record.output_pictures.push_back(
      {"outputs", outputs_figure(outputs, motion, PeriodWindow(response)), "the motion of each output"});
}

void append_outputs(Record& record, const Scene& scene, const RecordedMotion& motion) {
  const std::vector<Output> outputs = outputs_of(scene);
  Summary entries;
  for (std::size_t i = 0; i < scene.analysis.outputs.size(); ++i) {
    const Output& output = outputs[i];
    const auto of = [&](const char* quantity) {
      return motion.of(output.name, quantity).value / output.size;
    };
    if (output.names_quantity() || !std::isfinite(of("mean"))) continue;
    entries.emplace_back(output.column_of("max"), of("max"));
    entries.emplace_back(output.column_of("min"), of("min"));
    entries.emplace_back(output.column_of("half_peak_to_peak"), 0.5 * (of("max") - of("min")));
    entries.emplace_back(output.column_of("rms"), of("vibration_rms"));
    entries.emplace_back(output.column_of("mean"), of("mean"));
  }
  if (!entries.empty()) insert_outputs(record.summary, scene, outputs, std::move(entries));
}

void lead_with_output(Record& record, const Scene& scene) {
  const std::vector<Output> outputs = outputs_of(scene);
  const std::optional<std::size_t> leading = leading_output(outputs, scene);
  if (!leading || record.output_pictures.empty()) return;
  const std::vector<Panel>& drawn = record.output_pictures.front().figure.panels;
  if (*leading >= drawn.size()) return;
  std::vector<Panel>& panels = record.figure.panels;
  panels.insert(panels.begin(), drawn[*leading]);
  std::string& title = panels.front().title;
  title = outputs[*leading].names_quantity() ? capitalised(title) : "Motion of " + title;
}

}  // namespace wavebalance::app
