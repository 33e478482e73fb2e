#include "command/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "command/run_words.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

std::string heading_of(const Scene& scene) {
  static const std::vector<std::pair<AnalysisType, const char*>> kinds{
      {AnalysisType::forced_response, "Forced response"},
      {AnalysisType::frequency_sweep, "Frequency response"},
      {AnalysisType::nonlinear_mode, "Nonlinear mode"},
      {AnalysisType::time_stepping, "Response by time stepping"}};
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const auto& one) { return one.first == scene.analysis.type; });
  const std::string structure = scene.structure.type == StructureType::matrices
                                    ? "of a structure of matrices"
                                    : "of a " + name_of(scene.structure.type);
  return std::string(kind->second) + " " + structure;
}

/// The gap of all contacts; NaN where they differ or there is none.
double one_gap(const Contact& contact) {
  const bool one = contact.law != ContactLawType::none && contact.gaps.empty() && contact.pairs.empty();
  return one ? contact.gap : std::numeric_limits<double>::quiet_NaN();
}

std::string paragraph(const std::vector<std::string>& sentences) {
  return sentences.empty()
             ? ""
             : fmt::format("<p>{}</p>\n", escaped(fmt::format("{}", fmt::join(sentences, " "))));
}

std::string list(const std::vector<std::string>& items) {
  std::string text = "<ul>\n";
  for (const auto& item : items) text += "<li>" + escaped(item) + "</li>\n";
  return text + "</ul>\n";
}

std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escaped(title), body);
}

std::string folded(const std::string& title, const std::string& body) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(title), body);
}

/// An argument as a shell takes it.
std::string shell_word(const std::string& text) {
  const bool ordinary = !text.empty() && text.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_-+=./:,@%") == std::string::npos;
  if (ordinary) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string command_of(const RunArguments& arguments) {
  std::string text = "wavebalance run " + shell_word(arguments.scene.string());
  for (const auto& one : arguments.overrides) text += " --set " + shell_word(one);
  for (const auto& one : arguments.removed) text += " --unset " + shell_word(one);
  return text + " --output " + shell_word(arguments.output.string());
}

std::string value_text(const SummaryValue& value) {
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    return fmt::format("{}", fmt::join(*list, ", "));
  if (const auto* words = std::get_if<std::vector<std::string>>(&value))
    return fmt::format("{}", fmt::join(*words, "; "));
  if (const auto* number = std::get_if<double>(&value)) return cell_text(*number);
  if (const auto* count = std::get_if<std::int64_t>(&value)) return cell_text(*count);
  if (const auto* truth = std::get_if<bool>(&value)) return cell_text(*truth);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return fmt::format("{} rows", std::get<Table>(value).rows());
}

std::string values_table(const Summary& summary) {
  std::vector<std::vector<std::string>> rows{{"name", "value"}};
  for (const auto& [name, value] : summary) rows.push_back({name, value_text(value)});
  return table_html(rows);
}

/// The cells of a table as text below the names of its columns.
std::vector<std::vector<std::string>> text_rows(const Table& table) {
  std::vector<std::vector<std::string>> rows{table.columns()};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    rows.emplace_back();
    for (const Cell& cell : table.row(i)) rows.back().push_back(cell_text(cell));
  }
  return rows;
}

std::string special_points_table(const Summary& summary) {
  for (const auto& [name, value] : summary)
    if (const auto* table = std::get_if<Table>(&value);
        table != nullptr && name == "special_points" && !table->empty())
      return folded("Special points", table_html(text_rows(*table)));
  return "";
}

std::string files_list(const std::vector<ResultFile>& files) {
  std::string text = "<ul>\n<li><a href=\"summary.json\">summary.json</a>: all values</li>\n";
  for (const auto& file : files)
    if (!file.name.ends_with(".vtu"))
      text += fmt::format("<li><a href=\"{0}\">{0}</a>: {1}</li>\n", escaped(file.name), escaped(file.about));
  return text + "</ul>\n";
}

/// The picture that `files` holds, with curves that zoom where its data are among them.
std::string picture(const std::vector<ResultFile>& files, const std::string& heading) {
  const auto named = [&](const std::string& suffix) {
    return std::find_if(files.begin(), files.end(),
                        [&](const auto& file) { return file.name.ends_with(suffix); });
  };
  const auto drawn = named(".svg");
  if (drawn == files.end()) return "<p>There is no picture: gnuplot was not found.</p>\n";
  FigureBlock block{drawn->name.substr(0, drawn->name.size() - 4)};
  block.alternative = heading;
  block.curves = named(".figure.js") != files.end();
  return figure_html(block);
}

/// The box in which motion.js moves the bar, where its data are among the files.
std::string motion(const std::vector<ResultFile>& files) {
  const auto found = std::find_if(files.begin(), files.end(),
                                  [](const auto& file) { return file.name.ends_with(".motion.js"); });
  return found == files.end()
             ? ""
             : fmt::format("<h3>Motion</h3>\n<div class=\"motion\" data-motion=\"{}\"></div>\n", found->name);
}

std::string asked(const RunArguments& arguments, const Scene& scene) {
  return "<p>The command:</p>\n<pre><code>" + escaped(command_of(arguments)) +
         "</code></pre>\n<p>What it solves:</p>\n<pre><code>" + escaped(describe_scene(scene)) +
         "</code></pre>\n" +
         folded("The scene as it was solved",
                "<pre><code>" + escaped(write_scene(scene)) + "</code></pre>\n");
}

}  // namespace

std::string report_text(const RunArguments& arguments, const Scene& scene, const Record& record,
                        const Summary& summary, const std::vector<ResultFile>& files) {
  const std::string heading = heading_of(scene);
  PageParts page;
  page.title = heading + ", Wavebalance";
  page.assets = "";
  page.libraries = {Library::d3};
  page.scripts = {"motion.js"};
  page.body =
      "<main>\n<h1>" + escaped(heading) + "</h1>\n" +
      section("What came out", paragraph(outcome_sentences(summary, one_gap(scene.contact))) +
                                   picture(files, heading) + motion(files)) +
      section("Stability",
              paragraph(stability_sentences(summary, record.sweep)) + special_points_table(summary)) +
      section("Warnings", record.warnings.empty() ? "" : list(record.warnings)) +
      section("What was asked", asked(arguments, scene)) +
      section("Files", files_list(files) + folded("All values of the summary", values_table(summary))) +
      fmt::format("<p class=\"quiet\">Wavebalance {}</p>\n</main>\n", version());
  return page_html(page);
}

}  // namespace wavebalance::app
