#include "results/unstable_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/sweep_axis.hpp"

namespace wavebalance::app {
namespace {

bool is_matched(solvers::StructurePointStatus status) {
  return status == solvers::StructurePointStatus::found || status == solvers::StructurePointStatus::repeated;
}

bool is_jump(solvers::SpecialPointType type) {
  return type == solvers::SpecialPointType::grazing || type == solvers::SpecialPointType::slip ||
         type == solvers::SpecialPointType::stick;
}

/// A fold, say, of the structure beside one of its grazings, which the balance has not: its samples take both
/// for one.
std::optional<double> left_out_beside(const solvers::StructurePoints& structure, std::size_t event) {
  const auto has_it = [&](std::size_t other) {
    return std::any_of(structure.of_balance.begin(), structure.of_balance.end(),
                       [&](const auto& near) { return near.event == other && is_matched(near.status); });
  };
  for (const std::size_t other : {event - 1, event + 1})
    if (other < structure.events.size() && !is_jump(structure.events[other].type) && !has_it(other))
      return structure.events[other].value;
  return std::nullopt;
}

/// Where the special point of a curve lies: that of the structure where its whole curve was followed.
double place_of(const Sweep& sweep, std::size_t number, std::size_t index) {
  const bool main = number == 0;
  const solvers::SpecialPoint& point =
      (main ? sweep.stability : sweep.branches[number - 1].stability).special_points[index];
  if (main && sweep.structure_points && sweep.structure_points->whole) {
    const solvers::NearStructurePoint& near = sweep.structure_points->of_balance[index];
    const std::optional<double> other = is_matched(near.status) && is_jump(point.type)
                                            ? left_out_beside(*sweep.structure_points, near.event)
                                            : std::nullopt;
    if (is_matched(near.status)) return other.value_or(sweep.structure_points->events[near.event].value);
  }
  return parameter_of(point, sweep.curve.parameter);
}

/// The point at which stability changes between two neighbours whose stability is known, those before point
/// `first` and at point `last` of a curve: where multipliers pass the unit circle, or jump at a grazing or a
/// first slip.
std::optional<double> change_between(const Sweep& sweep, std::size_t number, std::size_t first,
                                     std::size_t last) {
  const auto& points = (number == 0 ? sweep.stability : sweep.branches[number - 1].stability).special_points;
  std::optional<double> jump;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].next_point < first || points[i].next_point > last) continue;
    jump = place_of(sweep, number, i);
    if (!is_jump(points[i].type)) return jump;
  }
  return jump;
}

void append_parts(Table& table, const Sweep& sweep, std::size_t number, std::size_t isola) {
  const solvers::FrequencySweep& curve = number == 0 ? sweep.curve : sweep.branches[number - 1].curve;
  const std::vector<solvers::PointStability> points = sweep.stability_of(number).points;
  const auto place = [&](std::size_t i) { return parameter_of(curve.points[i], curve.parameter); };
  for (std::size_t i = 0; i < points.size() && i < curve.points.size(); ++i) {
    if (points[i].unstable <= 0) continue;
    const std::size_t first = i;
    while (i + 1 < points.size() && points[i + 1].unstable > 0) ++i;
    std::size_t before = first, after = i + 1;  // past points whose stability is not known
    while (before > 0 && points[before - 1].unstable < 0) --before;
    while (after + 1 < points.size() && points[after].unstable < 0) ++after;
    std::vector<Cell> row{std::int64_t(number),
                          change_between(sweep, number, before, first).value_or(place(first)),
                          change_between(sweep, number, i + 1, after).value_or(place(i))};
    if (table.has_column("isola")) row.emplace_back(std::int64_t(isola));
    table.append_row(std::move(row));
  }
}

}  // namespace

Table unstable_parts(const Sweep& sweep) {
  const SweepAxis axis = sweep_axis(sweep);
  std::vector<std::string> columns{"branch", "begin_" + axis.suffix, "end_" + axis.suffix};
  if (!sweep.isolas.empty()) columns.emplace_back("isola");
  Table table(columns);
  for (std::size_t isola = 0; isola <= sweep.isolas.size(); ++isola) {
    const Sweep& one = isola == 0 ? sweep : sweep.isolas[isola - 1];
    for (std::size_t number = 0; number <= one.branches.size(); ++number)
      append_parts(table, one, number, isola);
  }
  return table;
}

}  // namespace wavebalance::app
