#include "results/analyses.hpp"

#include <fmt/ranges.h>

#include <numeric>
#include <set>

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "results/quantities.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/attractors/bifurcation.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

const char* way_of(const DiagramValue& one) { return one.forwards ? "there" : "back"; }

Table section_table(const Diagram& diagram) {
  const std::string& unit = diagram.places[std::size_t(diagram.place)].unit;
  Table table({diagram.axis.column(), "way", "period", "point", "displacement_" + unit,
               "velocity_" + unit + "_per_s"});
  for (const DiagramValue& one : diagram.values)
    for (int k = 0; k < points_shown(one); ++k)
      table.append_row(row_of(one.value, way_of(one), one.period, k + 1, one.displacement(diagram.place, k),
                              one.velocity(diagram.place, k)));
  return table;
}

Table exact_table(const Diagram& diagram) {
  const std::string& unit = diagram.places[std::size_t(diagram.place)].unit;
  Table table({diagram.axis.column(), "branch", "period", "point", "displacement_" + unit,
               "velocity_" + unit + "_per_s", "unstable"});
  int point = 0, branch = -1;
  for (const ExactLine& line : diagram.exact) {
    point = line.branch == branch ? point + 1 : 1;
    branch = line.branch;
    for (std::size_t i = 0; i < line.value.size(); ++i)
      table.append_row(row_of(line.value[i], line.branch, line.periods, point, line.displacement[i],
                              line.velocity[i], line.unstable[i] < 0 ? missing : double(line.unstable[i])));
  }
  return table;
}

/// Frequency of the load at a value.
double load_frequency(const Scene& scene, const DiagramValue& one) {
  return is_over_amplitude(scene.analysis) ? scene.forcing.frequency : one.value;
}

/// Type and range of displacements of the motion at each value.
Table envelope_table(const Scene& scene, const Diagram& diagram) {
  std::vector<std::string> columns{
      diagram.axis.column(), "way", "period", "second_frequency_Hz", "rotation_number", "curve_residual",
      "curve_harmonics"};
  for (const MotionPlace& place : diagram.places)
    for (const char* which : {"_max_", "_min_"})
      columns.push_back(column_of(place.name) + which + place.unit);
  Table table(columns);
  for (const DiagramValue& one : diagram.values) {
    if (!one.failure.empty()) continue;
    const bool found = one.is_quasi_periodic();
    const double rotation = found ? one.curve.rotation : missing;
    std::vector<Cell> row = row_of(one.value, way_of(one), one.period, rotation * load_frequency(scene, one),
                                   rotation, one.period == 0 && !one.settles ? one.curve.residual : missing,
                                   found ? double(one.curve.harmonics()) : missing);
    for (std::size_t i = 0; i < diagram.places.size(); ++i)
      for (const Eigen::VectorXd* reach : {&one.highest, &one.lowest})
        row.emplace_back((*reach)[Eigen::Index(i)]);
    table.append_row(std::move(row));
  }
  return table;
}

/// Neighbouring values of one way and one period, in their order.
Table intervals_table(const Diagram& diagram) {
  Table table({"way", "from", "to", "values", "period"});
  const std::vector<DiagramValue>& values = diagram.values;
  for (std::size_t i = 0, next = 0; i < values.size(); i = next) {
    const auto alike = [&](const DiagramValue& one) {
      return one.forwards == values[i].forwards && one.period == values[i].period &&
             one.failure == values[i].failure && one.settles == values[i].settles;
    };
    for (next = i; next < values.size() && alike(values[next]);) ++next;
    table.append_row(
        row_of(way_of(values[i]), values[i].value, values[next - 1].value, next - i,
               values[i].failure.empty() && !values[i].settles ? double(values[i].period) : missing));
  }
  return table;
}

/// The least over all shifts of the largest distance of the points of two motions of one period.
double distance_of(const DiagramValue& a, const DiagramValue& b, int place) {
  double least = std::numeric_limits<double>::infinity();
  for (int shift = 0; shift < a.period; ++shift) {
    double largest = 0.0;
    for (int k = 0; k < a.period; ++k)
      largest = std::max(largest, std::abs(a.displacement(place, k) - b.displacement(place, k + shift)));
    least = std::min(least, largest);
  }
  return least;
}

/// Whether both ways lead to different motions at a value; two aperiodic ones are not distinguished, nor a
/// transient from its attractor.
bool differ(const DiagramValue& there, const DiagramValue& back, int place, double alike) {
  if (there.settles || back.settles) return false;
  if (!there.failure.empty() || !back.failure.empty()) return false;
  if (there.period != back.period) return true;
  return there.period > 0 && distance_of(there, back, place) > alike;
}

/// The value on the way back; null without one.
const DiagramValue* back_at(const Diagram& diagram, double value) {
  for (const DiagramValue& one : diagram.values)
    if (!one.forwards && one.value == value) return &one;
  return nullptr;
}

/// Neighbouring values at which both ways lead to different motions.
Table hysteresis_table(const Diagram& diagram, double tolerance) {
  constexpr double clear = 30.0;  // of the tolerance, which points of one motion may miss near a bifurcation
  Table table({"from", "to", "values", "period_there", "period_back"});
  double size = 0.0;
  for (const DiagramValue& one : diagram.values)
    if (one.displacement.size() > 0)
      size = std::max(size, one.displacement.row(diagram.place).cwiseAbs().maxCoeff());
  std::vector<std::vector<Cell>> runs;
  bool before = false;
  for (const DiagramValue& there : diagram.values) {
    if (!there.forwards) break;
    const DiagramValue* back = back_at(diagram, there.value);
    const bool apart = back != nullptr && differ(there, *back, diagram.place, clear * tolerance * size);
    const bool goes_on = apart && before && std::get<std::int64_t>(runs.back()[3]) == there.period &&
                         std::get<std::int64_t>(runs.back()[4]) == back->period;
    if (goes_on) {
      runs.back()[1] = there.value;
      ++std::get<std::int64_t>(runs.back()[2]);
    } else if (apart) {
      runs.push_back(row_of(there.value, there.value, 1, there.period, back->period));
    }
    before = apart;
  }
  for (std::vector<Cell>& run : runs) table.append_row(std::move(run));
  return table;
}

std::int64_t sum_of(const Table& table, const char* column) {
  std::int64_t sum = 0;
  for (const double value : table.numbers(column)) sum += std::int64_t(value);
  return sum;
}

/// "12 to 19.5", or one value.
std::string interval_text(const Table& table, std::size_t row) {
  const double from = table.numbers("from")[row], to = table.numbers("to")[row];
  return from == to ? short_number(from, 6) : short_number(from, 6) + " to " + short_number(to, 6);
}

/// "12 to 19.5, 22 and 4 more" of the rows.
std::string list_text(const Table& table, const std::vector<std::size_t>& rows) {
  constexpr std::size_t most = 4;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(most, rows.size()); ++i)
    parts.push_back(interval_text(table, rows[i]));
  return fmt::format("{}", fmt::join(parts, ", ")) +
         (rows.size() > most ? fmt::format(" and {} more", rows.size() - most) : "");
}

/// Where motions of few periods are on a way, where others, and where none.
std::string way_sentence(const Table& intervals, const std::string& way, const SweepAxis& axis) {
  constexpr std::array words{"period 1 at ",      "period 2 at ",  "period 4 at ",
                             "other periods at ", "aperiodic at ", "not known at "};
  std::array<std::vector<std::size_t>, words.size()> rows;
  const std::vector<double> periods = intervals.numbers("period");
  for (std::size_t i = 0; i < intervals.rows(); ++i) {
    if (cell_text(intervals.at(i, "way")) != way) continue;
    const double period = periods[i];
    const std::size_t kind = std::isnan(period) ? 5
                             : period == 0.0    ? 4
                             : period == 1.0    ? 0
                             : period == 2.0    ? 1
                             : period == 4.0    ? 2
                                                : 3;
    rows[kind].push_back(i);
  }
  std::vector<std::string> parts;
  for (std::size_t kind = 0; kind < words.size(); ++kind)
    if (!rows[kind].empty()) parts.push_back(words[kind] + list_text(intervals, rows[kind]));
  if (parts.empty()) return "";
  return fmt::format("{} ({}): {}.", way == "there" ? "Forward" : "Backward", axis.unit,
                     fmt::join(parts, "; "));
}

std::string hysteresis_sentence(const Table& hysteresis, bool both_ways, const SweepAxis& axis) {
  if (!both_ways) return "The values were passed in one direction only.";
  if (hysteresis.empty()) return "Both directions lead to the same motions.";
  std::vector<std::size_t> rows(hysteresis.rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return fmt::format("Both directions lead to different motions at {} {}.", list_text(hysteresis, rows),
                     axis.unit);
}

std::string quasi_periodic_sentence(std::int64_t aperiodic, std::int64_t quasi_periodic) {
  if (aperiodic == 0) return "";
  if (quasi_periodic == 0) return "None of the aperiodic motions is quasi-periodic.";
  return fmt::format(
      "{} of {} aperiodic motions {} quasi-periodic: the section is a closed curve. envelope.csv has the "
      "second frequency.",
      quasi_periodic, aperiodic, quasi_periodic == 1 ? "is" : "are");
}

std::string exact_sentence(const Diagram& diagram) {
  const std::string &status = diagram.exact_status, &back = diagram.exact_status_back;
  if (status == "reached_end" || status == "closed")
    return "Lines are exact periodic solutions, dashed where they are unstable.";
  if (status == "not_sought" && diagram.places[std::size_t(diagram.place)].output)
    return "Exact curves are drawn for sections of contacts only.";
  if (status == "not_sought" || status.empty()) return "";
  if (status == "refused") return "There is no exact curve of this scene.";
  const std::string lines = "Lines are exact periodic solutions, dashed where they are unstable. ";
  return back.empty() ? lines + "They begin at one end of the interval (" + spaced_words(status) + ")."
                      : lines + "They begin at both ends of the interval (" + spaced_words(status) + ", " +
                            spaced_words(back) + "). Others may be missing.";
}

std::int64_t count_of(const Diagram& diagram, bool (*which)(const DiagramValue&)) {
  return std::ranges::count_if(diagram.values, which);
}

bool is_aperiodic(const DiagramValue& one) { return one.failure.empty() && one.period == 0 && !one.settles; }
bool is_quasi_periodic(const DiagramValue& one) { return one.is_quasi_periodic(); }

std::vector<std::string> sentences_of(const Diagram& diagram, int values, const Table& intervals,
                                      const Table& hysteresis) {
  const bool any = std::ranges::any_of(diagram.values, [](const auto& one) { return one.failure.empty(); });
  std::vector<std::string> sentences{
      fmt::format("The section of {} was recorded at {} values of the {}, in {}.",
                  diagram.places[std::size_t(diagram.place)].name, values, diagram.axis.quantity,
                  quantity(diagram.wall_seconds, "s")),
      way_sentence(intervals, "there", diagram.axis),
      way_sentence(intervals, "back", diagram.axis),
      quasi_periodic_sentence(count_of(diagram, is_aperiodic), count_of(diagram, is_quasi_periodic)),
      any ? hysteresis_sentence(hysteresis, !diagram.values.back().forwards, diagram.axis) : "",
      exact_sentence(diagram)};
  std::erase(sentences, "");
  return sentences;
}

void append_findings(Record& record, const Scene& scene, const Diagram& diagram) {
  double most = missing, least = missing;
  int longest = 0;
  for (const DiagramValue& one : diagram.values) {
    longest = std::max(longest, one.period);
    if (one.displacement.size() == 0) continue;
    most = std::fmax(most, one.displacement.row(diagram.place).maxCoeff());
    least = std::fmin(least, one.displacement.row(diagram.place).minCoeff());
  }
  record.add("section_of", diagram.places[std::size_t(diagram.place)].name);
  record.add("max_section_displacement", most);
  record.add("min_section_displacement", least);
  record.add(quantities::aperiodic_values, count_of(diagram, is_aperiodic));
  record.add(quantities::quasi_periodic_values, count_of(diagram, is_quasi_periodic));
  record.add(quantities::longest_found, longest);
  const Table hysteresis = hysteresis_table(diagram, scene.analysis.section_tolerance);
  record.add(quantities::hysteresis_values, sum_of(hysteresis, "values"));
  const Table intervals = intervals_table(diagram);
  record.sentences = sentences_of(diagram, scene.analysis.values, intervals, hysteresis);
  record.add("period_intervals", intervals);
  record.add("hysteresis", hysteresis);
  record.add("exact_curve", diagram.exact_status);
  if (!diagram.exact_status_back.empty()) record.add("exact_curve_back", diagram.exact_status_back);
  const auto failed = count_of(diagram, [](const DiagramValue& one) { return !one.failure.empty(); });
  std::set<std::string> reasons;
  for (const DiagramValue& one : diagram.values)
    if (!one.failure.empty()) reasons.insert(one.failure);
  if (failed > 0)
    warn(record,
         "At {} values the integration ended before the section was complete ({}). They have no points, and "
         "the next value starts from rest.",
         failed, fmt::join(reasons, ", "));
  const auto settling = count_of(diagram, [](const DiagramValue& one) { return one.settles; });
  if (settling > 0)
    warn(record, "At {} values the motion was still transient. analysis.transient_periods sets its time.",
         settling);
  if (diagram.exact_status != "not_sought" && diagram.exact.empty())
    warn(record, "There is no exact curve over the interval ({}).", diagram.exact_status);
}

}  // namespace

std::string diagram_plan(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  return fmt::format(
      "diagram    {} values{}, {} forcing periods at each, the last {} are recorded{}\nsize       {} states\n",
      analysis.values, analysis.both_ways ? " forward and backward" : "",
      analysis.transient_periods + analysis.section_points, analysis.section_points,
      analysis.exact_curve ? ", and the exact curve" : "", 2 * reduced_size(scene));
}

Record diagram_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  const Diagram diagram = bifurcation_diagram(scene, model, how.observer);
  Record record;
  record.warnings = model.warnings;
  record.converged = diagram.status == "converged";
  record.interrupted = diagram.status == "interrupted";
  record.status = diagram.status;
  const int periods =
      int(diagram.values.size()) * (scene.analysis.transient_periods + scene.analysis.section_points);
  begin_summary(record, missing, periods, 2 * model.size(), diagram.wall_seconds);
  record.add(quantities::analysis, name_of(scene.analysis.type));
  record.add(quantities::diagram_values, scene.analysis.values);
  warn_of_scene(record, scene);
  record.axis = diagram.axis;
  if (!diagram.values.empty()) append_findings(record, scene, diagram);
  append_structure(record.summary, scene, model);
  record.add(quantities::warnings, record.warnings);
  if (diagram.values.empty()) return record;
  record.section = section_table(diagram);
  record.files.push_back(
      {"envelope.csv", csv_text(envelope_table(scene, diagram)),
       "period or second frequency at each value, and the largest and least displacement of each place"});
  if (!diagram.exact.empty())
    record.files.push_back({"exact_curve.csv", csv_text(exact_table(diagram)),
                            "the exact curve in the section, with the multipliers outside the unit circle"});
  record.figure = diagram_figure(diagram);
  return record;
}

}  // namespace wavebalance::app
