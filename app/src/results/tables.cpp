#include "wavebalance/app/results/record.hpp"

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/outputs.hpp"
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
  const bool directed = has_directions(places), named = !contact_labels(scene).empty();
  std::vector<std::string> columns{"time_fraction", "contact", "displacement_m", "contact_force_N"};
  if (directed) columns.insert(columns.begin() + 2, "direction");
  if (named) columns.emplace_back("name");
  Table table(columns);
  const Eigen::VectorXd times = time_fractions(contacts.points());
  for (int l = 0; l < contacts.points(); ++l)
    for (int row = 0; row < contacts.rows(); ++row) {
      const SceneContact& place = places[std::size_t(row)];
      std::vector<Cell> cells{times[l], std::int64_t{place.number}};
      if (directed) cells.emplace_back(direction_name(place));
      cells.insert(cells.end(), {contacts.displacement(row, l), contacts.force(row, l)});
      if (named) cells.emplace_back(whole_name_of(place));
      table.append_row(std::move(cells));
    }
  return table;
}

namespace {

using solvers::SweepPoint;

Summary point_row(const SweepPoint& point, solvers::SweepParameter parameter, const std::string& place) {
  return {{place, parameter_of(point, parameter)},
          {quantities::max_displacement, point.max_displacement},
          {quantities::rms_displacement, point.rms_displacement},
          {quantities::min_displacement, point.min_displacement},
          {"max_abs_displacement_m", point.max_abs_displacement},
          {quantities::max_contact_force, point.max_force},
          {quantities::contact_fraction, point.contact_fraction},
          {quantities::vibration, point.vibration},
          {quantities::rms_vibration, point.rms_vibration}};
}

/// Additional columns of the table of a sweep.
struct MoreColumns {
  bool stability, exact, branches, isolas;
  /// The contact degrees of freedom with separate columns, or none.
  std::vector<SceneContact> contacts = {};
};

/// How the columns of a contact begin.
std::string contact_column(const SceneContact& contact) { return column_of(whole_name_of(contact)); }

/// The work and wear of friction at each contact.
void append_works(Summary& row, const FrictionShares& shares, const std::vector<SceneContact>& contacts,
                  double frequency) {
  for (const ContactFriction& one : shares.each) {
    const std::string column =
        contact_column(*std::ranges::find(contacts, one.number, &SceneContact::number));
    row.emplace_back(column + "_work_J", one.work);
    if (one.wears) row.emplace_back(column + "_wear_m3_per_s", one.wear * frequency);
  }
}

/// The curve of a sweep, 0, or of a branch, from 1; `isola` is the number of the sweep among the isolas.
struct CurveRows {
  const Sweep& sweep;
  MoreColumns more;
  std::size_t number = 0, isola = 0;
  const solvers::FrequencySweep& curve = sweep.curve_of(number);
  int periods = sweep.periods * (number == 0 ? 1 : sweep.branches[number - 1].periods);
  StabilityAlong stability = sweep.stability_of(number);

  /// A point of the curve; beyond them one that shows the columns.
  Summary operator()(std::size_t i) const {
    Summary row = point_row(at(curve.points, i), curve.parameter, sweep_axis(sweep).column());
    const auto put = [&](const auto& name, auto value) { row.emplace_back(name, value); };
    if (more.stability) {
      const bool known = i < stability.points.size();
      put("unstable", known && stability.points[i].unstable >= 0 ? stability.points[i].unstable : missing);
      put("contacts", known ? stability.points[i].contacts : missing);
    }
    if (!sweep.impacts.empty()) {
      const PointImpacts& impacts = at(sweep.impacts[number], i);
      put(quantities::impacts, impacts.count);
      put(quantities::max_impulse, impacts.largest_impulse);
      put(quantities::impact_energy, impacts.energy_lost);
      put(quantities::max_impact_velocity, impacts.largest_speed);
      for (std::size_t k = 0; k < more.contacts.size(); ++k)
        if (more.contacts[k].place == 0)
          put(contact_column(more.contacts[k]) + "_max_impact_velocity_m_per_s",
              k < impacts.speeds.size() ? impacts.speeds[k] : 0.0);
    }
    if (!sweep.friction.empty()) {
      const std::vector<FrictionShares>& along = sweep.friction[number];
      append_shares(row, at(along, i));
      const double frequency = i < curve.points.size() ? curve.points[i].frequency / periods : missing;
      if (!more.contacts.empty())
        append_works(row, at(along, std::min(i, along.size() - 1)), more.contacts, frequency);
    }
    if (more.branches) put("branch", number);
    if (more.branches) put("period", periods);
    if (more.isolas) put(quantities::isola, isola);
    if (!more.exact) return row;
    const ExactAlongSweep* exact = sweep.exact_of(number);
    append_exact(row, exact == nullptr ? ExactAlongSweep::Point() : at(exact->points, i));
    if (more.stability) put(quantities::stability_by, i < stability.by.size() ? stability.by[i] : "none");
    return row;
  }

 private:
  template <class Value>
  static const Value& at(const std::vector<Value>& values, std::size_t i) {
    static const Value none{};
    return i < values.size() ? values[i] : none;
  }
};

void append_curve(Table& table, const CurveRows& rows) {
  for (std::size_t i = 0; i < rows.curve.points.size(); ++i) table.append_row(cells_of(rows(i)));
}

}  // namespace

Table sweep_table(const solvers::FrequencySweep& curve) {
  const std::string place = quantities::frequency.column();
  return tabulated(curve.points,
                   [&](const SweepPoint& point) { return point_row(point, curve.parameter, place); });
}

Table sweep_table(const Sweep& sweep, bool with_branches, const std::vector<SceneContact>& contacts) {
  const ExactAlongSweep* exact = sweep.exact_of(0);
  const MoreColumns more{with_branches || !sweep.stability.points.empty(),
                         exact != nullptr && !exact->points.empty(), with_branches,
                         !sweep.isola_search.frequencies.empty(), contacts};
  const CurveRows first{sweep, more};
  Table table(columns_of(first(first.curve.points.size())));
  append_curve(table, first);
  for (std::size_t i = 1; with_branches && i <= sweep.branches.size(); ++i)
    append_curve(table, {sweep, more, i});
  for (std::size_t i = 0; i < sweep.isolas.size(); ++i)
    append_curve(table, {sweep.isolas[i], more, 0, i + 1});
  return table;
}

}  // namespace wavebalance::app
