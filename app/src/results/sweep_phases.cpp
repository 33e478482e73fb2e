#include "results/sweep_phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/sweep_axis.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

double displacement_error(const SweepPhases::Point& point) {
  return point ? point->displacement_error : missing;
}

double force_error(const SweepPhases::Point& point) { return point ? point->force_error : missing; }

double largest_of(const std::vector<SweepPhases::Point>& points, double (*error)(const SweepPhases::Point&)) {
  double largest = missing;
  for (const SweepPhases::Point& point : points) largest = std::fmax(largest, error(point));
  return largest;
}

/// Over the curve and its branches.
void append_phases_of_points(Record& record, const Sweep& sweep) {
  std::vector<SweepPhases::Point> points;
  for (const SweepPhases& curve : sweep.phases)
    points.insert(points.end(), curve.points.begin(), curve.points.end());
  if (points.empty()) return;
  const auto found = std::count_if(points.begin(), points.end(), [](const SweepPhases::Point& point) {
    return point && point->status == solvers::PhasesStatus::converged;
  });
  const auto none = std::count_if(points.begin(), points.end(), was_not_found);
  const auto all = static_cast<std::int64_t>(points.size());
  record.summary.emplace_back(quantities::largest_error_of_displacement,
                              largest_of(points, displacement_error));
  record.summary.emplace_back(quantities::largest_error_of_force, largest_of(points, force_error));
  record.summary.emplace_back(quantities::points_phases_converged, std::int64_t{found});
  record.summary.emplace_back(quantities::points_not_found, std::int64_t{none});
  record.summary.emplace_back(quantities::points_phases_not_known, all - found - none);
  if (none == 0) return;
  record.warnings.push_back(fmt::format(
      "At {} of {} points of the curve contact phases found no motion of the structure near the response, as between the "
      "folds of the balance and those of the structure. No verdict of stability is given there. More functions may lead to "
      "a motion.",
      none, all));
}

/// "the fold at 1312.3 Hz", of those without a motion near.
void append_places(std::vector<std::string>& places, const std::vector<solvers::SpecialPoint>& points,
                   const SweepPhases& phases, const Sweep& sweep) {
  for (std::size_t i = 0; i < phases.special_points.size(); ++i) {
    if (!was_not_found(phases.special_points[i])) continue;
    std::string type(to_string(points[i].type));
    std::replace(type.begin(), type.end(), '_', ' ');
    places.push_back(fmt::format("the {} at {:.7g} {}", type, parameter_of(points[i], sweep.curve.parameter),
                                 sweep_axis(sweep).unit));
  }
}

void warn_of_places(Record& record, const Sweep& sweep) {
  std::vector<std::string> places;
  if (was_not_found(sweep.phases.front().peak)) places.emplace_back("the peak");
  append_places(places, sweep.stability.special_points, sweep.phases.front(), sweep);
  for (std::size_t i = 1; i < sweep.phases.size(); ++i)
    append_places(places, sweep.branches[i - 1].stability.special_points, sweep.phases[i], sweep);
  if (places.empty()) return;
  record.warnings.push_back(fmt::format(
      "No motion of the structure was found near these points of the curve: {}. The balance solves the equations at its "
      "samples alone there, and whether the structure has these points is not known. More functions may lead to them.",
      fmt::join(places, ", ")));
}

}  // namespace

std::vector<std::string> phases_columns() {
  return {quantities::error_of_displacement.column(), quantities::error_of_force.column(),
          quantities::phases_status.column()};
}

std::vector<Cell> phases_cells(const SweepPhases::Point& point) {
  return {displacement_error(point), force_error(point), phases_status(point)};
}

void append_phases(Record& record, const Sweep& sweep) {
  if (sweep.phases.empty()) return;
  const SweepPhases::Point& peak = sweep.phases.front().peak;
  record.summary.emplace_back(quantities::phases_status, phases_status(peak));
  record.summary.emplace_back(quantities::error_of_displacement, displacement_error(peak));
  record.summary.emplace_back(quantities::error_of_force, force_error(peak));
  append_phases_of_points(record, sweep);
  warn_of_places(record, sweep);
}

}  // namespace wavebalance::app
