#include "results/output_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "drawing/output_figure.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/sweep_record.hpp"
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

/// The table with the columns of all outputs.
Table with_outputs(const Table& table, const SweepOutputs& outputs, int harmonics, bool with_branches) {
  std::vector<std::string> columns = table.columns();
  for (const Output& output : outputs.outputs)
    for (std::string& column : columns_of(output, harmonics)) columns.push_back(std::move(column));
  Table wide(columns);
  const std::vector<const MeasuredPoint*> points = in_rows(outputs, with_branches);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<Cell> cells = table.row(row);
    const MeasuredPoint* point = row < points.size() ? points[row] : nullptr;
    for (std::size_t i = 0; i < outputs.outputs.size(); ++i) {
      const bool known = point != nullptr && !point->empty();
      for (const double cell :
           cells_of(outputs.outputs[i], known ? (*point)[i] : OutputMeasures(), harmonics))
        cells.emplace_back(cell);
    }
    wide.append_row(std::move(cells));
  }
  return wide;
}

double relative_error(double value, double exact) { return std::abs(value - exact) / std::abs(exact); }

/// Where along the curve each output vibrates most, how well its points resolve that, and the error of the
/// vibration at the peak of the curve where the exact motion is known there.
Table peaks_table(const Sweep& sweep, const SweepOutputs& outputs) {
  Table table({"output", "unit", sweep_axis(sweep).column(), "half_peak_to_peak", "max", "min", "mean",
               quantities::peak_value_resolution.column(), quantities::peak_place_resolution.column(),
               "error_at_peak"});
  std::vector<double> places;
  for (const solvers::SweepPoint& point : sweep.curve.points)
    places.push_back(parameter_of(point, sweep.curve.parameter));
  const MeasuredPoint& at_peak = outputs.curves[0][peak_of(sweep.curve)];
  for (std::size_t i = 0; i < outputs.outputs.size(); ++i) {
    const Output& output = outputs.outputs[i];
    OutputMeasures best;
    std::size_t peak = 0;
    std::vector<double> values(places.size(), missing);
    for (std::size_t k = 0; k < outputs.curves[0].size(); ++k) {
      const MeasuredPoint& point = outputs.curves[0][k];
      if (!point.empty()) values[k] = point[i].half_peak_to_peak();
      if (point.empty() || point[i].half_peak_to_peak() <= best.half_peak_to_peak()) continue;
      best = point[i];
      peak = k;
    }
    const bool known = std::isfinite(best.max);
    const PeakResolution resolution = peak_resolution(places, values, peak);
    const bool exact = !outputs.exact_at_peak.empty() && !at_peak.empty();
    table.append_row(
        {output.name, output.unit, known ? places[peak] : missing, best.half_peak_to_peak(), best.max,
         best.min, best.mean, known ? resolution.value : missing, known ? resolution.place : missing,
         exact ? relative_error(at_peak[i].half_peak_to_peak(), outputs.exact_at_peak[i].half_peak_to_peak())
               : missing});
  }
  return table;
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

void append_leading_output(Summary& summary, const Scene& scene, const std::vector<Output>& outputs) {
  if (const auto leading = leading_output(outputs, scene))
    summary.emplace_back(quantities::leading_output, outputs[*leading].name);
}

}  // namespace

void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs) {
  if (outputs.empty()) return;
  record.sweep =
      with_outputs(record.sweep, outputs, scene.analysis.output_harmonics, scene.analysis.branches);
  record.add(quantities::outputs, peaks_table(sweep, outputs));
  append_leading_output(record.summary, scene, outputs.outputs);
  if (!sweep.curve.points.empty())
    record.output_pictures.push_back(
        {"outputs", outputs_figure(sweep, outputs), "the vibration of each output along the curve"});
}

void append_outputs(Record& record, const Scene& scene, const StructureModel& model,
                    const Response& response) {
  const std::vector<Output> outputs = outputs_of(scene);
  if (outputs.empty() || !response.moves || response.contacts.empty()) return;
  const Eigen::MatrixXd motion =
      motion_of_outputs(outputs, scene, model, response.contacts, response.structure.displacement);
  const int harmonics = scene.analysis.output_harmonics;
  const Eigen::MatrixXd force = response.forces_are_known() ? response.contacts.force : Eigen::MatrixXd();
  record.outputs.add_column("time_fraction", time_fractions(int(motion.cols())));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    record.outputs.add_column(outputs[i].column + "_" + outputs[i].unit,
                              Eigen::VectorXd(motion.row(Eigen::Index(i)).transpose()));
  record.add(quantities::outputs,
             measures_table(outputs, measure(outputs, motion, force, harmonics, response.periods),
                            exact_outputs(scene, model, response, outputs), harmonics));
  append_leading_output(record.summary, scene, outputs);
  record.output_pictures.push_back(
      {"outputs", outputs_figure(outputs, motion, PeriodWindow(response)), "the motion of each output"});
}

void lead_with_output(Record& record, const Scene& scene) {
  const std::optional<std::size_t> leading = leading_output(outputs_of(scene), scene);
  if (!leading || record.output_pictures.empty()) return;
  const std::vector<Panel>& drawn = record.output_pictures.front().figure.panels;
  if (*leading >= drawn.size()) return;
  std::vector<Panel>& panels = record.figure.panels;
  panels.insert(panels.begin(), drawn[*leading]);
  panels.front().title = "Motion of " + panels.front().title;
}

}  // namespace wavebalance::app
