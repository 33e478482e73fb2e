#include "results/structure_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "analysis/sweep_axis.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

using solvers::StructurePointStatus;

bool is_known(const solvers::NearStructurePoint& near) {
  return near.status == StructurePointStatus::found || near.status == StructurePointStatus::repeated;
}

std::int64_t count_of(const solvers::StructurePoints& points, StructurePointStatus status) {
  return std::count_if(points.of_balance.begin(), points.of_balance.end(),
                       [status](const auto& near) { return near.status == status; });
}

/// How many special points of the balance lie nearest to that of the structure.
std::int64_t copies_of(const solvers::StructurePoints& points, std::size_t event) {
  return std::count_if(points.of_balance.begin(), points.of_balance.end(),
                       [event](const auto& near) { return is_known(near) && near.event == event; });
}

/// Uniform over the period.
Eigen::VectorXd instants() {
  constexpr Eigen::Index count = 1024;
  return Eigen::VectorXd::LinSpaced(count, 0.0, 1.0 - 1.0 / double(count));
}

Table table_of(const solvers::StructurePoints& points, const SweepAxis& axis) {
  Table table({"type", axis.column(), "multiplier_real", "multiplier_imag", "max_displacement_m", "contacts",
               "error_of_displacement", "of_balance"});
  for (std::size_t i = 0; i < points.events.size(); ++i) {
    const solvers::ExactEvent& event = points.events[i];
    table.append_row({std::string(to_string(event.type)), event.value, event.multiplier.real(),
                      event.multiplier.imag(), event.motion.displacement(instants()).maxCoeff(),
                      std::int64_t(event.motion.phases.size()), event.motion.estimated_error,
                      copies_of(points, i)});
  }
  return table;
}

std::string range_of(const std::vector<double>& places) {
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  return *low == *high ? fmt::format("{:.6g}", *low) : fmt::format("{:.6g} to {:.6g}", *low, *high);
}

/// That a step of the curve was too long.
void warn_of_parts_missed(Record& record, const solvers::StructurePoints& points, const std::string& unit) {
  if (points.apart)
    record.warnings.push_back(
        "The motions near the first and the last point of the curve lie on different curves of the structure: the "
        "curve has gone over from one to the other.");
  if (points.passed_by.empty()) return;
  std::vector<double> places;
  for (const std::size_t fold : points.passed_by) places.push_back(points.events[fold].value);
  record.warnings.push_back(fmt::format(
      "The curve of the structure has {} fold{} that this curve passes by, at {} {}: what lies between "
      "them is missing.",
      places.size(), places.size() == 1 ? "" : "s", range_of(places), unit));
}

}  // namespace

Table with_structure_points(const Table& special_points, const Sweep& sweep) {
  std::vector<std::string> columns = special_points.columns();
  columns.insert(columns.end(), {"structure_" + sweep_axis(sweep).column(), "structure_status"});
  Table table(columns);
  for (std::size_t i = 0; i < special_points.rows(); ++i) {
    const solvers::NearStructurePoint& near = sweep.structure_points->of_balance[i];
    std::vector<Cell> row;
    for (const std::string& column : special_points.columns()) row.push_back(special_points.at(i, column));
    row.push_back(is_known(near) ? sweep.structure_points->events[near.event].value : missing);
    row.push_back(std::string(to_string(near.status)));
    table.append_row(std::move(row));
  }
  return table;
}

std::optional<std::vector<double>> structure_folds(const Sweep& sweep) {
  if (!sweep.structure_points || !sweep.structure_points->whole) return std::nullopt;
  std::vector<double> folds;
  for (const solvers::ExactEvent& event : sweep.structure_points->events)
    if (event.type == solvers::SpecialPointType::fold) folds.push_back(event.value);
  return folds;
}

void append_structure_points(Record& record, const Sweep& sweep) {
  if (!sweep.structure_points) return;
  const solvers::StructurePoints& points = *sweep.structure_points;
  record.summary.emplace_back(quantities::structure_curve, std::string(points.whole ? "whole" : "stretches"));
  warn_of_parts_missed(record, points, sweep_axis(sweep).unit);
  record.summary.emplace_back(quantities::structure_special_points, table_of(points, sweep_axis(sweep)));
  const std::int64_t repeated = count_of(points, StructurePointStatus::repeated),
                     none = count_of(points, StructurePointStatus::none),
                     left = count_of(points, StructurePointStatus::not_known) +
                            count_of(points, StructurePointStatus::not_sought);
  std::vector<std::string> errors;
  if (repeated > 0) errors.push_back(fmt::format("{} repeat one of the structure", repeated));
  if (none > 0) errors.push_back(fmt::format("{} have none of their type near", none));
  if (!errors.empty())
    record.warnings.push_back(fmt::format(
        "Of {} special points of the curve {} are an error of the functions and points: {}. {}",
        points.of_balance.size(), repeated + none, fmt::join(errors, " and "),
        points.events.empty()
            ? std::string("No special point of the structure was found.")
            : fmt::format("structure_special_points lists the {} of the structure.", points.events.size())));
  if (left == 0) return;
  record.warnings.push_back(
      fmt::format("For {} of {} special points of the curve it is not known whether the structure has them: "
                  "structure_status names them.",
                  left, points.of_balance.size()));
}

}  // namespace wavebalance::app
