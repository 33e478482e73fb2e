#include "results/output_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "analysis/sweep_axis.hpp"
#include "drawing/output_figure.hpp"
#include "files/missing.hpp"
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

/// Where along the curve each output vibrates most.
Table peaks_table(const Sweep& sweep, const SweepOutputs& outputs) {
  Table table({"output", "unit", sweep_axis(sweep).column(), "half_peak_to_peak", "max", "min", "mean"});
  for (std::size_t i = 0; i < outputs.outputs.size(); ++i) {
    const Output& output = outputs.outputs[i];
    OutputMeasures best;
    double place = missing;
    for (std::size_t k = 0; k < outputs.curves[0].size(); ++k) {
      const MeasuredPoint& point = outputs.curves[0][k];
      if (point.empty() || point[i].half_peak_to_peak() <= best.half_peak_to_peak()) continue;
      best = point[i];
      place = parameter_of(sweep.curve.points[k], sweep.curve.parameter);
    }
    table.append_row(
        {output.name, output.unit, place, best.half_peak_to_peak(), best.max, best.min, best.mean});
  }
  return table;
}

/// One row for each output, with the names of columns that columns_of() has, but for the output's own name.
Table measures_table(const std::vector<Output>& outputs, const MeasuredPoint& measured, int harmonics) {
  std::vector<std::string> columns{"output", "unit", "max", "min", "half_peak_to_peak", "rms", "mean"};
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
    while (row.size() < columns.size()) row.emplace_back(missing);
    table.append_row(std::move(row));
  }
  return table;
}

}  // namespace

void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs) {
  if (outputs.empty()) return;
  record.sweep =
      with_outputs(record.sweep, outputs, scene.analysis.output_harmonics, scene.analysis.branches);
  record.summary.emplace_back(quantities::outputs, peaks_table(sweep, outputs));
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
  // Of impacts only the force of contacts that last is known.
  const bool forces = !response.impacts || !response.impacts->motion.lasting.empty();
  const Eigen::MatrixXd force = forces ? response.contacts.force : Eigen::MatrixXd();
  record.outputs.add_column("time_fraction", time_fractions(int(motion.cols())));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    record.outputs.add_column(outputs[i].column + "_" + outputs[i].unit,
                              Eigen::VectorXd(motion.row(Eigen::Index(i)).transpose()));
  record.summary.emplace_back(
      quantities::outputs,
      measures_table(outputs, measure(outputs, motion, force, harmonics, response.periods), harmonics));
  record.output_pictures.push_back(
      {"outputs", outputs_figure(outputs, motion, response.periods), "the motion of each output"});
}

}  // namespace wavebalance::app
