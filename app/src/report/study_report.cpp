#include "report/reports.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>

#include "files/number_text.hpp"
#include "report/page_parts.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/files/npz.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/files/record_folder.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/app/scene/output_words.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t most_failures = 20;

std::string command_of_study(const StudyArguments& arguments) {
  return "wavebalance study " + shell_word(arguments.study.string()) + " --output " +
         shell_word(arguments.output.string());
}

/// The command that solves the run of a single row.
std::string command_of_row(const Study& study, const Table& table, std::size_t row) {
  std::string text = "wavebalance run " + shell_word(study.scene.string());
  for (const std::string& one : study.unset) text += " --unset " + shell_word(one);
  for (const std::string& one : study.set) text += " --set " + shell_word(one);
  for (const StudyParameter& one : study.parameters)
    text += " --set " + shell_word(one.key + "=" + cell_text(table.at(row, one.key)));
  return text + " --output run" + cell_text(table.at(row, "run"));
}

std::vector<std::size_t> failures_of(const Table& table) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.rows() && rows.size() < most_failures; ++i)
    if (!std::get<bool>(table.at(i, "converged"))) rows.push_back(i);
  return rows;
}

/// Why runs failed: each message once, with the runs that have it.
std::string messages_html(const Table& table, const std::vector<std::size_t>& rows) {
  std::vector<std::string> messages;
  std::map<std::string, std::vector<std::string>> runs;
  for (const std::size_t row : rows) {
    const std::string message = cell_text(table.at(row, "message"));
    if (message.empty()) continue;
    if (runs[message].empty()) messages.push_back(message);
    runs[message].push_back(cell_text(table.at(row, "run")));
  }
  std::vector<std::string> items;
  for (const std::string& message : messages) {
    const auto& which = runs[message];
    items.push_back(
        fmt::format("Run{} {}: {}", which.size() == 1 ? "" : "s", fmt::join(which, ", "), message));
  }
  return items.empty() ? "" : list_html(items);
}

std::string failures_html(const Study& study, const StudyRecord& record) {
  const std::vector<std::size_t> failures = failures_of(record.table);
  if (failures.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"run"}};
  for (const StudyParameter& one : study.parameters) rows.front().push_back(one.key);
  rows.front().push_back("status");
  for (const std::size_t i : failures) {
    rows.push_back({cell_text(record.table.at(i, "run"))});
    for (const StudyParameter& one : study.parameters)
      rows.back().push_back(cell_text(record.table.at(i, one.key)));
    rows.back().push_back(cell_text(record.table.at(i, "status")));
  }
  const std::string which =
      failures.size() == most_failures
          ? fmt::format("<p>The first {} are shown; study.csv holds all.</p>\n", most_failures)
          : "";
  return which + table_html(rows) + messages_html(record.table, failures) +
         "<p>This command solves only the first one:</p>\n" +
         code_html(command_of_row(study, record.table, failures.front()));
}

/// A value of a column with the unit of its quantity: "21.63 mm".
std::string value_text(const std::string& column, double value) {
  if (const Quantity* known = quantities::find_in_words(column))
    return quantity(value, std::string(known->unit));
  if (const OutputUnit* unit = unit_at_end(column))
    return quantity(value, unit->name == "um" ? "µm" : std::string(unit->name));
  return column.ends_with("_seconds") ? quantity(value, "s") : short_number(value);
}

std::string words_of(const std::string& column) {
  const Quantity* known = quantities::find_in_words(column);
  return known == nullptr ? column : std::string(known->words);
}

/// The runs with the largest and the least value of the quantity in the pictures, and the command for the
/// first of them.
std::string extremes_html(const Study& study, const StudyRecord& record) {
  const std::string quantity = text_in(record.summary, {"quantity"});
  if (quantity.empty()) return "";
  const std::vector<double> values = record.table.numbers(quantity);
  std::optional<std::size_t> largest, least;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::get<bool>(record.table.at(i, "converged")) || !std::isfinite(values[i])) continue;
    if (!largest || values[i] > values[*largest]) largest = i;
    if (!least || values[i] < values[*least]) least = i;
  }
  if (!largest || *largest == *least) return "";
  const auto run = [&](std::size_t i) {
    return fmt::format("{} in run {}", value_text(quantity, values[i]), cell_text(record.table.at(i, "run")));
  };
  return "<p>" +
         escaped(fmt::format(
             "Range of the {}: {} to {}. study.csv has a row for each run. This command solves only run {}:",
             words_of(quantity), run(*least), run(*largest), cell_text(record.table.at(*largest, "run")))) +
         "</p>\n" + code_html(command_of_row(study, record.table, *largest));
}

/// Whether a quantity describes the solution process, not the result.
bool is_of_the_solver(const std::string& quantity) {
  static const std::set<std::string> names{"residual",
                                           "iterations",
                                           "phases_estimated_error",
                                           "phases_unknowns",
                                           "condition_estimate",
                                           "rounding_error_estimate",
                                           "leading_multiplier_real",
                                           "leading_multiplier_imag",
                                           "leading_multiplier_error"};
  return names.contains(quantity);
}

/// The table of quantiles with units.
std::string quantiles_html(const Study& study, const Summary& summary) {
  const Table* table = table_of(summary, "quantiles");
  if (table == nullptr) return "";
  std::vector<std::vector<std::string>> rows{table->columns()};
  const bool varies_frequency = std::ranges::any_of(
      study.parameters, [](const StudyParameter& one) { return one.key == "forcing.frequency"; });
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const std::string name = cell_text(table->at(i, "quantity"));
    if (is_of_the_solver(name) || (varies_frequency && name == "frequency_Hz")) continue;
    rows.emplace_back();
    for (const Cell& cell : table->row(i)) {
      const auto* number = std::get_if<double>(&cell);
      rows.back().push_back(number == nullptr ? cell_text(cell) : value_text(name, *number));
    }
  }
  return "<p>Quantiles over the runs that converged: 5 % of them do not exceed q05. summary.json "
         "has the quantiles of all columns.</p>\n" +
         table_html(rows, true);
}

std::string asked(const StudyArguments& arguments, const Study& study) {
  std::string parameters;
  for (const StudyParameter& one : study.parameters)
    parameters += one.is_interval() ? fmt::format("{} from {} to {}{}\n", one.key, number_text(one.from),
                                                  number_text(one.to), one.logarithmic ? ", logarithmic" : "")
                                    : fmt::format("{} of {} values\n", one.key, one.values.size());
  return "<p>The command, which continues where it stopped:</p>\n" + code_html(command_of_study(arguments)) +
         fmt::format("<p>The parameters ({}):</p>\n", name_of(study.sampling)) + code_html(parameters) +
         folded("The scene", code_html(study.scene_text));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// "pipe over contact.gap and forcing.amplitude"; of many parameters their number.
std::string heading_of(const Study& study) {
  constexpr std::size_t most = 3;
  std::vector<std::string> keys;
  for (const StudyParameter& one : study.parameters) keys.push_back(one.key);
  const std::string over = keys.size() > most ? fmt::format("{} parameters", keys.size())
                                              : fmt::format("{}", fmt::join(keys, " and "));
  return study.scene.stem().string() + " over " + over;
}

std::string study_report(const StudyArguments& arguments, const Study& study, const StudyRecord& record,
                         const Summary& summary, const std::vector<RecordFile>& files) {
  const std::string heading = heading_of(study);
  PageParts page{.title = heading + ", Wavebalance"};
  page.body = section_html("Results", list_html(lines_of(study_outcome(record)))) +
              section_html("Pictures", pictures_html(record.pictures, files) + extremes_html(study, record)) +
              section_html("Quantiles", quantiles_html(study, summary)) +
              section_html("Runs that did not converge", failures_html(study, record)) +
              last_sections(record.warnings, asked(arguments, study), files, summary);
  return report_page(std::move(page), heading);
}

}  // namespace

std::string study_outcome(const StudyRecord& record) {
  const Summary& summary = record.summary;
  std::string text = fmt::format("{:.0f} of {:.0f} runs have ended, and {:.0f} of them converged.\n",
                                 number_in(summary, {"runs_ended"}), number_in(summary, {"runs"}),
                                 number_in(summary, {"runs_converged"}));
  const Table* statuses = table_of(summary, "statuses");
  for (std::size_t i = 0; statuses != nullptr && i < statuses->rows(); ++i)
    if (cell_text(statuses->at(i, "status")) != "converged")
      text +=
          fmt::format("{:<22}{}\n", cell_text(statuses->at(i, "status")), cell_text(statuses->at(i, "runs")));
  for (const std::string& change : record.changes) text += change + "\n";
  return text;
}

InputFiles inputs_of(const StudyArguments& arguments, const Study& study, const StudyRuns& runs) {
  InputFiles inputs = inputs_of(study.scene, scene_of_run(study, runs, 0));
  inputs.push_back(arguments.study);
  return inputs;
}

void check_study_output(const StudyArguments& arguments, const InputFiles& inputs) {
  const auto writes = [&](const std::string& name) {
    if (name == "report.html") return arguments.report;
    for (const char* one :
         {"summary.json", "scene.toml", "study.csv", "study.npz", "study.svg", "study.figure.js"})
      if (name == one) return true;
    return false;
  };
  require_replaceable(arguments.output, writes, inputs);
}

RunFiles study_files(const StudyArguments& arguments, const Study& study, const StudyRecord& record) {
  RunFiles run;
  std::vector<RecordFile>& files = run.files;
  if (arguments.report) files.push_back({"report.html", "", "the report of this study"});
  files.push_back({"study.csv", csv_text(record.table), "a row per run"});
  files.push_back({"study.npz", npz_text(record.table), "the same columns for numpy.load()"});
  files.push_back({"scene.toml", study.scene_text, "the scene of all runs, before their changes"});
  run.no_picture = append_pictures(files, record.pictures, arguments.report);
  Summary summary = record.summary;
  summary.emplace_back("study", study.name);
  summary.emplace_back("scene", study.scene.string());
  append_files(summary, files);
  if (arguments.report) files.front().contents = study_report(arguments, study, record, summary, files);
  run.summary = json_text(summary);
  return run;
}

}  // namespace wavebalance::app
