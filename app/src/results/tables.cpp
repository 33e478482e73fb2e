#include "wavebalance/app/results/tables.hpp"

#include <cstdint>
#include <utility>

#include "analysis/sweep_axis.hpp"
#include "files/missing.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::app {

Table response_table(const solvers::Motion& contact) {
  Table table;
  table.add_column("time_fraction", time_fractions(contact.points()))
      .add_column("displacement_m", contact.displacement)
      .add_column("velocity_m_per_s", contact.velocity)
      .add_column("contact_force_N", contact.force);
  return table;
}

Table contacts_table(const solvers::Motion& contacts) {
  Table table({"time_fraction", "contact", "displacement_m", "contact_force_N"});
  const Eigen::VectorXd times = time_fractions(contacts.points());
  for (int l = 0; l < contacts.points(); ++l)
    for (int contact = 0; contact < contacts.rows(); ++contact)
      table.append_row({times[l], std::int64_t{contact + 1}, contacts.displacement(contact, l),
                        contacts.force(contact, l)});
  return table;
}

namespace {

const std::vector<std::string> point_columns{
    "frequency_Hz",           "max_displacement_m",  "rms_displacement_m", "min_displacement_m",
    "max_abs_displacement_m", "max_contact_force_N", "contact_fraction"};

std::vector<Cell> point_cells(const solvers::SweepPoint& point, solvers::SweepParameter parameter) {
  return {parameter_of(point, parameter), point.max_displacement,     point.rms_displacement,
          point.min_displacement,         point.max_abs_displacement, point.max_force,
          point.contact_fraction};
}

void append_rows(Table& table, const solvers::FrequencySweep& curve,
                 const std::vector<solvers::PointStability>& stability, int branch, int period) {
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const bool known = i < stability.size();
    std::vector<Cell> row = point_cells(curve.points[i], curve.parameter);
    row.emplace_back(known && stability[i].unstable >= 0 ? stability[i].unstable : missing);
    row.emplace_back(known ? stability[i].contacts : missing);
    row.emplace_back(std::int64_t{branch});
    row.emplace_back(std::int64_t{period});
    table.append_row(std::move(row));
  }
}

/// With the name of its first column.
Table points_table(const solvers::FrequencySweep& curve, const std::string& place) {
  std::vector<std::string> columns = point_columns;
  columns.front() = place;
  Table table(columns);
  for (const auto& point : curve.points) table.append_row(point_cells(point, curve.parameter));
  return table;
}

}  // namespace

Table sweep_table(const solvers::FrequencySweep& curve) { return points_table(curve, point_columns.front()); }

Table sweep_table(const Sweep& sweep, bool with_branches) {
  if (with_branches) {
    std::vector<std::string> columns = point_columns;
    columns.insert(columns.end(), {"unstable", "contacts", "branch", "period"});
    Table table(columns);
    append_rows(table, sweep.curve, sweep.stability.points, 0, sweep.periods);
    int number = 0;
    for (const solvers::Branch& branch : sweep.branches)
      append_rows(table, branch.curve, branch.stability.points, ++number, branch.periods * sweep.periods);
    return table;
  }
  Table table = points_table(sweep.curve, sweep_axis(sweep).column());
  const auto& points = sweep.stability.points;
  if (points.empty()) return table;
  std::vector<double> unstable(table.rows(), missing), contacts(table.rows(), missing);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].unstable >= 0) unstable[i] = points[i].unstable;
    contacts[i] = points[i].contacts;
  }
  return table.add_column("unstable", unstable).add_column("contacts", contacts);
}

}  // namespace wavebalance::app
