#include "results/record_parts.hpp"

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

using solvers::StructurePointStatus;

bool is_known(const solvers::NearStructurePoint& near) {
  return near.status == StructurePointStatus::found || near.status == StructurePointStatus::repeated;
}

std::int64_t count_of(const solvers::StructurePoints& points, StructurePointStatus status) {
  return std::ranges::count_if(points.of_balance,
                               [status](const auto& near) { return near.status == status; });
}

/// How many points of the balance are nearest to an exact one.
std::int64_t copies_of(const solvers::StructurePoints& points, std::size_t event) {
  return std::ranges::count_if(points.of_balance,
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
    table.append_row(row_of(to_string(event.type), event.value, event.multiplier.real(),
                            event.multiplier.imag(), event.motion.displacement(instants()).maxCoeff(),
                            event.motion.intervals.size(), event.motion.estimated_error,
                            copies_of(points, i)));
  }
  return table;
}

std::string range_of(const std::vector<double>& places) {
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  return *low == *high ? short_number(*low, 6) : short_number(*low, 6) + " to " + short_number(*high, 6);
}

/// That a step of the curve was too long.
void warn_of_parts_missed(Record& record, const solvers::StructurePoints& points, const std::string& unit) {
  if (points.apart)
    record.warnings.push_back(
        "The exact solutions near the first and the last point are on different branches: the "
        "curve jumped from one to the other.");
  if (points.passed_by.empty()) return;
  std::vector<double> places;
  for (const std::size_t fold : points.passed_by) places.push_back(points.events[fold].value);
  warn(
      record,
      "The exact branch has {} fold{} that this curve misses, at {} {}: the segment between them is missing.",
      places.size(), places.size() == 1 ? "" : "s", range_of(places), unit);
}

bool is_matched(solvers::StructurePointStatus status) {
  return status == solvers::StructurePointStatus::found || status == solvers::StructurePointStatus::repeated;
}

bool is_jump(solvers::SpecialPointType type) {
  return type == solvers::SpecialPointType::grazing || type == solvers::SpecialPointType::slip ||
         type == solvers::SpecialPointType::stick;
}

/// For example an exact fold next to a grazing, which the balance does not resolve.
std::optional<double> left_out_beside(const solvers::StructurePoints& structure, std::size_t event) {
  const auto has_it = [&](std::size_t other) {
    return std::ranges::any_of(structure.of_balance, [&](const auto& near) {
      return near.event == other && is_matched(near.status);
    });
  };
  for (const std::size_t other : {event - 1, event + 1})
    if (other < structure.events.size() && !is_jump(structure.events[other].type) && !has_it(other))
      return structure.events[other].value;
  return std::nullopt;
}

/// Where the bifurcation point of a curve is: the exact one where its whole curve was followed.
double place_of(const Sweep& sweep, std::size_t number, std::size_t index) {
  const bool main = number == 0;
  const solvers::SpecialPoint& point = sweep.balances_of(number).special_points[index];
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
  const auto& points = sweep.balances_of(number).special_points;
  std::optional<double> jump;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].next_point < first || points[i].next_point > last) continue;
    jump = place_of(sweep, number, i);
    if (!is_jump(points[i].type)) return jump;
  }
  return jump;
}

void append_parts(Table& table, const Sweep& sweep, std::size_t number, std::size_t isola) {
  const solvers::FrequencySweep& curve = sweep.curve_of(number);
  const std::vector<solvers::PointStability> points = sweep.stability_of(number).points;
  const auto place = [&](std::size_t i) { return parameter_of(curve.points[i], curve.parameter); };
  for (std::size_t i = 0; i < points.size() && i < curve.points.size(); ++i) {
    if (points[i].unstable <= 0) continue;
    const std::size_t first = i;
    while (i + 1 < points.size() && points[i + 1].unstable > 0) ++i;
    std::size_t before = first, after = i + 1;  // past points whose stability is not known
    while (before > 0 && points[before - 1].unstable < 0) --before;
    while (after + 1 < points.size() && points[after].unstable < 0) ++after;
    std::vector<Cell> row =
        row_of(number, change_between(sweep, number, before, first).value_or(place(first)),
               change_between(sweep, number, i + 1, after).value_or(place(i)));
    if (table.has_column("isola")) row.emplace_back(std::int64_t(isola));
    table.append_row(std::move(row));
  }
}

}  // namespace

Table with_structure_points(std::vector<Summary> special_points, const Sweep& sweep) {
  for (std::size_t i = 0; i < special_points.size(); ++i) {
    const solvers::NearStructurePoint& near = sweep.structure_points->of_balance[i];
    special_points[i].emplace_back(
        "structure_" + sweep_axis(sweep).column(),
        is_known(near) ? sweep.structure_points->events[near.event].value : missing);
    special_points[i].emplace_back("structure_status", to_string(near.status));
  }
  return table_of(special_points);
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
  record.add(quantities::structure_curve, points.whole ? "whole" : "stretches");
  warn_of_parts_missed(record, points, sweep_axis(sweep).unit);
  record.add(quantities::structure_special_points, table_of(points, sweep_axis(sweep)));
  const std::int64_t repeated = count_of(points, StructurePointStatus::repeated),
                     none = count_of(points, StructurePointStatus::none),
                     left = count_of(points, StructurePointStatus::not_known) +
                            count_of(points, StructurePointStatus::not_sought);
  if (repeated + none > 0)
    warn(
        record,
        "Bifurcation or grazing points of the curve: {}; discretisation artefacts among them: {} ({} repeated, {} "
        "without an exact point of the same type nearby). Exact points in structure_special_points: {}.",
        points.of_balance.size(), repeated + none, repeated, none, points.events.size());
  if (left == 0) return;
  warn(record,
       "For {} of {} bifurcation or grazing points of the curve no exact one was found or "
       "excluded: structure_status names them.",
       left, points.of_balance.size());
}

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
