#include "report/reports.hpp"

#include <fmt/format.h>

#include "report/page_parts.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

std::string command_of(const CompareArguments& arguments) {
  std::string text = "wavebalance compare " + shell_word(arguments.run.scene.string());
  if (!arguments.pairs.empty()) text += " --pairs " + shell_word(arguments.pairs);
  if (!arguments.error.empty()) text += " --error " + shell_word(arguments.error);
  text += fmt::format(" --budget {}", arguments.budget);
  if (!arguments.run.start_from.empty())
    text += " --start-from " + shell_word(arguments.run.start_from.string());
  for (const auto& one : arguments.run.overrides) text += " --set " + shell_word(one);
  for (const auto& one : arguments.run.removed) text += " --unset " + shell_word(one);
  return text + " --output " + shell_word(arguments.run.output.string());
}

/// As pictures name it.
std::string pair_of(const Table& table, std::size_t row) {
  const std::string trial = cell_text(table.at(row, "trial")), weight = cell_text(table.at(row, "weight"));
  return trial.empty() ? "" : label_of({trial, weight});
}

/// Times and peaks with units; a missing value is empty.
Cell shown(const std::string& column, const Cell& cell) {
  const auto* value = std::get_if<double>(&cell);
  const bool is_time = column.ends_with("seconds");
  if (value == nullptr || (!is_time && column != "max_displacement_m")) return cell;
  return std::isfinite(*value) ? quantity(*value, is_time ? "s" : "m", is_time ? 3 : 4) : std::string();
}

/// The table with a column that names the pair of each row, which needs less space than two.
Table with_pairs(const Table& table) {
  std::vector<std::string> columns = table.columns();
  columns.push_back("pair");
  Table named(columns);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    std::vector<Cell> row;
    for (const std::string& column : table.columns()) row.push_back(shown(column, table.at(i, column)));
    row.emplace_back(pair_of(table, i));
    named.append_row(std::move(row));
  }
  return named;
}

/// Two sentences for each error, with the table to paste if it differs from the previous one.
std::string recommendations(const ComparisonRecord& record, const Summary& summary) {
  const Table* table = table_of(summary, "recommendations");
  if (table == nullptr) return "";
  std::string html, before;
  for (const Recommendation& one : record.recommendations) {
    html += fmt::format("<h3>For an error of {} in {}</h3>\n", short_number(one.error, 1),
                        subject_of(one.measure));
    html += paragraph({one.sentences});
    if (one.stability == "stable" || one.stability == "unstable")
      html += paragraph({"The motion is " + one.stability + "."});
    if (one.time_table.empty()) continue;
    html +=
        one.time_table == before ? "<p>The [time] table is the one above.</p>\n" : code_html(one.time_table);
    before = one.time_table;
  }
  const std::vector<std::pair<std::string, std::string>> columns{
      {"error", "requested error"},
      {"pair", "pair"},
      {"functions", "functions"},
      {"quadrature_points", "points"},
      {"seconds", "time"},
      {"displacement_error", "error of the displacement"},
      {"force_error", "error of the force"},
      {"fourier_time_ratio", "time of Fourier:Fourier relative to it"},
      {"phases_seconds", "time of the exact solution, if less"}};
  return html + "<h3>Comparison</h3>\n" + columns_html(with_pairs(*table), columns);
}

/// Each reason once, with the pairs that it excludes.
std::string excluded_pairs(const Table& table) {
  std::vector<std::vector<std::string>> rows{{"pairs", "why"}};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const std::string why = cell_text(table.at(i, "failures"));
    const auto known = std::ranges::find_if(rows, [&](const auto& row) { return row[1] == why; });
    if (known == rows.end())
      rows.push_back({pair_of(table, i), why});
    else
      known->front() += ", " + pair_of(table, i);
  }
  return table_html(rows);
}

std::string pairs(const Summary& summary) {
  const Table* table = table_of(summary, "pairs");
  if (table == nullptr) return "";
  const Table admissible = table->where("admissible", "true"), others = table->where("admissible", "false");
  std::string html = columns_html(with_pairs(admissible), {{"pair", "pair"},
                                                           {"solves", "solves"},
                                                           {"converged", "converged"},
                                                           {"largest_functions", "most functions"},
                                                           {"smallest_error", "smallest error"},
                                                           {"order", "order"},
                                                           {"force_order", "order of the force"},
                                                           {"failures", "failures"}});
  if (!others.empty()) html += "<h3>Not admissible</h3>\n" + excluded_pairs(others);
  return html;
}

std::string curves(const ComparisonRecord& record, const Summary& summary) {
  if (table_of(summary, "curves") == nullptr) return "";
  return columns_html(with_pairs(record.table), {{"pair", "pair"},
                                                 {"functions", "functions"},
                                                 {"seconds", "time"},
                                                 {"curve_points", "points of the curve"},
                                                 {"max_displacement_m", "peak"},
                                                 {record.peak_column, "at (" + record.peak_unit + ")"},
                                                 {"turning_points", "turns"},
                                                 {"distance_from_finest", "distance from the finest"},
                                                 {"distance_from_exact", "distance from the exact curve"},
                                                 {"status", "status"}});
}

std::string reference_html(const Reference& reference) {
  if (reference.text.empty()) return "";
  if (!std::isfinite(reference.error))
    return paragraph({"No reference was found within its part of the budget."});
  std::vector<std::string> sentences{fmt::format("Reference: {}, accurate to {} in displacement.",
                                                 reference.text, short_number(reference.error, 1))};
  if (std::isfinite(reference.force_error))
    sentences.push_back(
        fmt::format("Its contact force is accurate to {}.", short_number(reference.force_error, 1)));
  const std::string& stability = reference.stability.status;
  if (stability == "stable" || stability == "unstable")
    sentences.push_back("The motion is " + stability + ".");
  else if (!stability.empty())
    sentences.push_back("Its stability is not known (" + stability + ").");
  return paragraph(sentences);
}

}  // namespace

std::string comparison_report(const CompareArguments& arguments, const Scene& scene,
                              const ComparisonRecord& record, const Summary& summary,
                              const std::vector<RecordFile>& files) {
  const bool sweep = table_of(summary, "curves") != nullptr;
  std::string outcome = record.converged
                            ? recommendations(record, summary)
                            : paragraph({"The comparison is not complete: " + record.status + "."});
  if (sweep) outcome += paragraph({record.text.substr(0, record.text.find("\n\n"))});
  const std::string name = arguments.run.scene.stem().string();
  const std::string heading = "Which basis for " + (name.empty() ? "this scene" : name) + "?";
  PageParts page{.title = heading + " Wavebalance"};
  page.body = section_html("Recommendation", outcome) +
              section_html("Pictures", pictures_html(record.pictures, files)) +
              section_html("Results of each pair", sweep ? curves(record, summary) : pairs(summary)) +
              section_html("Reference", reference_html(record.reference)) +
              last_sections(record.warnings,
                            "<p>The command:</p>\n" + code_html(command_of(arguments)) +
                                folded("The scene that was compared", code_html(write_scene(scene))),
                            files, summary);
  return report_page(std::move(page), heading);
}

}  // namespace wavebalance::app
