#include "wavebalance/app/study/study.hpp"

#include <fmt/format.h>

#include <numeric>

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "study/quantile.hpp"
#include "wavebalance/app/compose/outputs.hpp"

namespace wavebalance::app {
namespace {

/// A name of the summaries' values, and whether a row holds text for it.
struct ValueColumn {
  std::string name;
  bool text = false;
};

std::vector<ValueColumn> value_columns(const std::vector<StudyRow>& rows) {
  std::vector<ValueColumn> columns;
  std::map<std::string, std::size_t> places;
  for (const StudyRow& row : rows)
    for (const Entry& one : row.values) {
      const auto place = places.try_emplace(one.name, columns.size());
      if (place.second) columns.push_back({one.name, false});
      if (std::holds_alternative<std::string>(one.value)) columns[place.first->second].text = true;
    }
  return columns;
}

Cell found_cell(const StudyRow& row, const ValueColumn& column) {
  if (const Entry* found = find_entry(row.values, column.name)) return cell_of(found->value);
  return column.text ? Cell(std::string()) : Cell(missing);
}

/// The finite numbers of a column in the rows that converged, in order; empty if it holds text.
std::vector<double> ordered_values(const Table& table, std::size_t column) {
  std::vector<double> values;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const Cell& cell = table.row(i)[column];
    if (std::holds_alternative<std::string>(cell)) return {};
    if (!std::get<bool>(table.at(i, "converged"))) continue;
    const double value = std::visit(
        [](const auto& one) {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(one)>>) return static_cast<double>(one);
          return missing;
        },
        cell);
    if (std::isfinite(value)) values.push_back(value);
  }
  std::ranges::sort(values);
  return values;
}

void append_outcome(Summary& summary, const StudyOutcome& outcome, const Table& table) {
  const std::int64_t solved = outcome.solved;
  summary.emplace_back("workers", std::int64_t{outcome.workers});
  summary.emplace_back("processes_lost", std::int64_t{outcome.lost});
  summary.emplace_back("runs_solved_now", solved);
  summary.emplace_back(quantities::wall_seconds, outcome.wall_seconds);
  const std::vector<double> seconds = table.empty() ? std::vector<double>() : table.numbers("seconds");
  summary.emplace_back("seconds_of_all_runs", std::accumulate(seconds.begin(), seconds.end(), 0.0));
  summary.emplace_back("runs_per_second",
                       outcome.wall_seconds > 0.0 ? double(solved) / outcome.wall_seconds : missing);
}

std::string status_of(const StudyRecord& record) {
  return record.converged ? "converged" : record.complete ? "not_converged" : "interrupted";
}

/// The column of the vibration of an output of this name; empty where there is none.
std::string vibration_column(const Table& table, const std::string& output) {
  const std::string wanted = column_of(output) + "_half_peak_to_peak";
  for (const std::string& column : table.columns())
    if (!output.empty() && (column == wanted || column.starts_with(wanted + "_"))) return column;
  return "";
}

/// The output that leads in the first run that has one; empty without any.
std::string leading_output_in(const Table& table) {
  const std::string name = quantities::leading_output.column();
  if (!table.has_column(name)) return "";
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (const std::string text = cell_text(table.at(i, name)); !text.empty()) return text;
  return "";
}

/// "run 3 (contact.friction = 0.2)".
std::string run_text(const Study& study, const StudyRuns& runs, const StudyRow& row) {
  std::string values;
  for (std::size_t i = 0; i < runs.parameters(); ++i)
    values += (i == 0 ? "" : ", ") + study.parameters[i].key + " = " + runs.value(row.run, i);
  return fmt::format("run {} ({})", row.run + 1, values);
}

/// Change of the limit cycle from one row to the next; empty if there is none.
std::string change_between(const StudyRow& before, const StudyRow& after) {
  if (before.converged && !after.converged)
    return fmt::format("the limit cycle is lost (status {})", after.status);
  if (!before.converged && after.converged)
    return fmt::format("a limit cycle appears (before it, {})", before.status);
  const auto unstable = [](const StudyRow& row) {
    const Entry* found = find_entry(row.values, quantities::unstable_multipliers.column());
    const auto* count = found == nullptr ? nullptr : std::get_if<std::int64_t>(&found->value);
    return count == nullptr ? std::int64_t{-1} : *count;
  };
  const std::int64_t from = unstable(before), to = unstable(after);
  if (!after.converged || from < 0 || to < 0 || (from > 0) == (to > 0)) return "";
  return to > 0 ? "the limit cycle loses its stability" : "the limit cycle becomes stable";
}

std::vector<std::string> changes_along(const Study& study, const StudyRuns& runs,
                                       const std::vector<StudyRow>& rows) {
  std::vector<std::string> changes;
  for (std::size_t i = 1; study.follow && i < rows.size(); ++i) {
    const std::string change = change_between(rows[i - 1], rows[i]);
    if (!change.empty() && rows[i].run == rows[i - 1].run + 1)
      changes.push_back(fmt::format("Between {} and {} {}.", run_text(study, runs, rows[i - 1]),
                                    run_text(study, runs, rows[i]), change));
  }
  return changes;
}

}  // namespace

Table study_table(const Study& study, const StudyRuns& runs, const std::vector<StudyRow>& rows) {
  const std::vector<ValueColumn> values = value_columns(rows);
  std::vector<std::string> names{"run"};
  for (const StudyParameter& one : study.parameters) names.push_back(one.key);
  for (const char* name : {"status", "converged", "seconds"}) names.emplace_back(name);
  for (const ValueColumn& one : values) names.push_back(one.name);
  names.emplace_back("message");
  Table table(names);
  for (const StudyRow& row : rows) {
    std::vector<Cell> cells{row.run + 1};
    for (std::size_t i = 0; i < runs.parameters(); ++i) cells.push_back(runs.cell(row.run, i));
    cells.insert(cells.end(), {row.status, row.converged, row.seconds});
    for (const ValueColumn& one : values) cells.push_back(found_cell(row, one));
    cells.emplace_back(row.message);
    table.append_row(std::move(cells));
  }
  return table;
}

Table quantiles_table(const Study& study, const Table& table) {
  Table quantiles({"quantity", "runs", "mean", "min", "q05", "q25", "median", "q75", "q95", "max"});
  for (std::size_t j = study.parameters.size() + 4; j + 1 < table.columns().size(); ++j) {
    const std::vector<double> values = ordered_values(table, j);
    if (values.empty() || values.front() == values.back()) continue;
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    std::vector<Cell> row{table.columns()[j], static_cast<std::int64_t>(values.size()), mean, values.front()};
    for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95}) row.emplace_back(quantile_of(values, share));
    row.emplace_back(values.back());
    quantiles.append_row(std::move(row));
  }
  return quantiles;
}

Table statuses_table(const Table& table) {
  std::map<std::string, std::int64_t> counts;
  for (std::size_t i = 0; i < table.rows(); ++i) ++counts[std::get<std::string>(table.at(i, "status"))];
  std::vector<std::pair<std::string, std::int64_t>> ordered(counts.begin(), counts.end());
  std::ranges::stable_sort(ordered, [](const auto& a, const auto& b) { return a.second > b.second; });
  Table statuses({"status", "runs"});
  for (const auto& [status, count] : ordered) statuses.append_row({status, count});
  return statuses;
}

std::string drawn_quantity(const Study& study, const Table& table) {
  if (table.empty()) return "";
  if (table.has_column(study.quantity)) return study.quantity;
  for (const std::string& output : {study.quantity, leading_output_in(table)})
    if (const std::string column = vibration_column(table, output); !column.empty()) return column;
  const std::string usual = quantities::max_displacement.column();
  if (table.has_column(usual)) return usual;
  for (std::size_t j = study.parameters.size() + 4; j + 1 < table.columns().size(); ++j)
    if (!ordered_values(table, j).empty()) return table.columns()[j];
  return "";
}

StudyRecord study_record(const Study& study, const StudyRuns& runs, std::vector<StudyRow> rows,
                         const StudyOutcome& outcome, std::int64_t unreadable_lines) {
  std::ranges::sort(rows, [](const auto& a, const auto& b) { return a.run < b.run; });
  StudyRecord record;
  record.table = study_table(study, runs, rows);
  record.complete = std::int64_t(rows.size()) == runs.size();
  const auto converged = std::ranges::count_if(rows, [](const auto& row) { return row.converged; });
  record.converged = record.complete && converged == std::int64_t(rows.size());
  record.status = status_of(record);
  record.changes = changes_along(study, runs, rows);
  record.summary = {{quantities::converged, record.converged},
                    {quantities::status, record.status},
                    {"runs", runs.size()},
                    {"runs_ended", static_cast<std::int64_t>(rows.size())},
                    {"runs_converged", static_cast<std::int64_t>(converged)},
                    {"sampling", name_of(study.sampling)}};
  append_outcome(record.summary, outcome, record.table);
  record.summary.emplace_back("journal_lines_unreadable", unreadable_lines);
  const std::string quantity = drawn_quantity(study, record.table);
  if (!study.quantity.empty() && quantity != study.quantity &&
      quantity != vibration_column(record.table, study.quantity))
    record.warnings.push_back(fmt::format("quantity = \"{}\": no run has such a value; pictures show {}",
                                          study.quantity, quantity));
  record.summary.emplace_back(quantities::warnings, record.warnings);
  if (study.follow) record.summary.emplace_back("changes", record.changes);
  record.summary.emplace_back("quantity", quantity);
  record.summary.emplace_back("statuses", statuses_table(record.table));
  record.summary.emplace_back("quantiles", quantiles_table(study, record.table));
  Figure figure = study_figure(study, runs, record.table, quantity);
  if (!figure.panels.empty())
    record.pictures.push_back({"study", std::move(figure), "values of " + quantity + " over the parameters"});
  return record;
}

}  // namespace wavebalance::app
