#include "wavebalance/app/results/tables.hpp"

#include <cstdint>
#include <utility>

#include "analysis/sweep_axis.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/sweep_phases.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {

Table response_table(const solvers::Motion& contact) {
  Table table;
  table.add_column("time_fraction", time_fractions(contact.points()))
      .add_column("displacement_m", contact.displacement)
      .add_column("velocity_m_per_s", contact.velocity)
      .add_column("contact_force_N", contact.force);
  return table;
}

Table contacts_table(const Scene& scene, const solvers::Motion& contacts) {
  const std::vector<SceneContact> places = contact_places(scene);
  const bool directed = has_directions(places);
  Table table(
      directed ? std::vector<std::string>{"time_fraction", "contact", "direction", "displacement_m",
                                          "contact_force_N"}
               : std::vector<std::string>{"time_fraction", "contact", "displacement_m", "contact_force_N"});
  const Eigen::VectorXd times = time_fractions(contacts.points());
  for (int l = 0; l < contacts.points(); ++l)
    for (int row = 0; row < contacts.rows(); ++row) {
      const SceneContact& place = places[std::size_t(row)];
      std::vector<Cell> cells{times[l], std::int64_t{place.number}};
      if (directed) cells.emplace_back(direction_name(place));
      cells.insert(cells.end(), {contacts.displacement(row, l), contacts.force(row, l)});
      table.append_row(std::move(cells));
    }
  return table;
}

namespace {

const std::vector<std::string> point_columns{quantities::frequency.column(),
                                             quantities::max_displacement.column(),
                                             quantities::rms_displacement.column(),
                                             quantities::min_displacement.column(),
                                             "max_abs_displacement_m",
                                             quantities::max_contact_force.column(),
                                             quantities::contact_fraction.column(),
                                             quantities::vibration.column(),
                                             quantities::rms_vibration.column()};

std::vector<Cell> point_cells(const solvers::SweepPoint& point, solvers::SweepParameter parameter) {
  return {parameter_of(point, parameter),
          point.max_displacement,
          point.rms_displacement,
          point.min_displacement,
          point.max_abs_displacement,
          point.max_force,
          point.contact_fraction,
          point.vibration,
          point.rms_vibration};
}

/// Which columns a curve's table has beside those of its points.
struct MoreColumns {
  bool stability, phases, branches, isolas, impacts, friction;
};

std::vector<std::string> columns_of(const std::string& place, const MoreColumns& more) {
  std::vector<std::string> columns = point_columns;
  columns.front() = place;
  if (more.stability) columns.insert(columns.end(), {"unstable", "contacts"});
  if (more.impacts)
    columns.insert(columns.end(),
                   {"impacts", "max_impulse_Ns", "impact_energy_J", "max_impact_velocity_m_per_s"});
  if (more.friction)
    columns.insert(columns.end(), {"friction_work_J", "stick_fraction", "slip_fraction", "open_fraction"});
  if (more.branches) columns.insert(columns.end(), {"branch", "period"});
  if (more.isolas) columns.push_back(quantities::isola.column());
  if (!more.phases) return columns;
  for (std::string& column : phases_columns()) columns.push_back(std::move(column));
  if (more.stability) columns.push_back(quantities::stability_by.column());
  return columns;
}

/// The points of the curve, 0, or of a branch, from 1; `isola` is the number of the sweep among the isolas.
void append_rows(Table& table, const Sweep& sweep, std::size_t number, const MoreColumns& more,
                 std::int64_t isola = 0) {
  const solvers::FrequencySweep& curve = number == 0 ? sweep.curve : sweep.branches[number - 1].curve;
  const int periods = number == 0 ? 1 : sweep.branches[number - 1].periods;
  const StabilityAlong stability = sweep.stability_of(number);
  const SweepPhases* phases = sweep.phases_of(number);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    std::vector<Cell> row = point_cells(curve.points[i], curve.parameter);
    if (more.stability) {
      const bool known = i < stability.points.size();
      row.emplace_back(known && stability.points[i].unstable >= 0 ? stability.points[i].unstable : missing);
      row.emplace_back(known ? stability.points[i].contacts : missing);
    }
    if (more.impacts) {
      const PointImpacts& impacts = sweep.impacts[number][i];
      row.insert(row.end(), {std::int64_t{impacts.count}, impacts.largest_impulse, impacts.energy_lost,
                             impacts.largest_speed});
    }
    if (more.friction) {
      const FrictionShares& friction = sweep.friction[number][i];
      row.insert(row.end(), {friction.work, friction.stick, friction.slip, friction.open});
    }
    if (more.branches)
      row.insert(row.end(), {static_cast<std::int64_t>(number), std::int64_t{periods * sweep.periods}});
    if (more.isolas) row.emplace_back(isola);
    if (more.phases) {
      const bool sought = phases != nullptr && i < phases->points.size();
      for (Cell& cell : phases_cells(sought ? phases->points[i] : SweepPhases::Point()))
        row.push_back(std::move(cell));
      if (more.stability) row.emplace_back(i < stability.by.size() ? stability.by[i] : "none");
    }
    table.append_row(std::move(row));
  }
}

}  // namespace

Table sweep_table(const solvers::FrequencySweep& curve) {
  Table table(point_columns);
  for (const auto& point : curve.points) table.append_row(point_cells(point, curve.parameter));
  return table;
}

Table sweep_table(const Sweep& sweep, bool with_branches) {
  const SweepPhases* phases = sweep.phases_of(0);
  const MoreColumns more{with_branches || !sweep.stability.points.empty(),
                         phases != nullptr && !phases->points.empty(),
                         with_branches,
                         !sweep.isola_search.frequencies.empty(),
                         !sweep.impacts.empty(),
                         !sweep.friction.empty()};
  Table table(columns_of(sweep_axis(sweep).column(), more));
  append_rows(table, sweep, 0, more);
  for (std::size_t i = 1; with_branches && i <= sweep.branches.size(); ++i)
    append_rows(table, sweep, i, more);
  for (std::size_t i = 0; i < sweep.isolas.size(); ++i)
    append_rows(table, sweep.isolas[i], 0, more, static_cast<std::int64_t>(i) + 1);
  return table;
}

}  // namespace wavebalance::app
