#include "report/page_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plot/plot_parts.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

std::string value_text(const SummaryValue& value) {
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    return fmt::format("{}", fmt::join(*list, ", "));
  if (const auto* words = std::get_if<std::vector<std::string>>(&value))
    return fmt::format("{}", fmt::join(*words, "; "));
  const auto* table = std::get_if<Table>(&value);
  return table == nullptr ? cell_text(cell_of(value)) : fmt::format("{} rows", table->rows());
}

/// Columns of places along a curve.
bool is_place(const std::string& column) {
  return column.find("frequency_") != column.npos || column.starts_with("amplitude_");
}

/// A number with so many digits at most; empty for one that is missing.
std::string rounded_text(const Cell& cell, int digits) {
  const auto* number = std::get_if<double>(&cell);
  if (number == nullptr) return cell_text(cell);
  return std::isfinite(*number) ? short_number(*number, digits) : "";
}

}  // namespace

std::string paragraph(const std::vector<std::string>& sentences) {
  return sentences.empty()
             ? ""
             : fmt::format("<p>{}</p>\n", escaped(fmt::format("{}", fmt::join(sentences, " "))));
}

std::string list_html(const std::vector<std::string>& items) {
  std::string text = "<ul>\n";
  for (const auto& item : items) text += "<li>" + escaped(item) + "</li>\n";
  return text + "</ul>\n";
}

std::string sentences_html(const std::vector<std::string>& sentences) {
  constexpr std::size_t few = 2;
  return sentences.size() > few ? list_html(sentences) : paragraph(sentences);
}

std::vector<std::vector<std::string>> transposed(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::vector<std::string>> columns(rows.empty() ? 0 : rows.front().size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const auto& row : rows) columns[i].push_back(row.at(i));
  return columns;
}

std::string section_html(const std::string& title, const std::string& body) {
  return body.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escaped(title), body);
}

std::string folded(const std::string& title, const std::string& body) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(title), body);
}

std::string code_html(const std::string& text) {
  return "<pre><code>" + with_options(text) + "</code></pre>\n";
}

std::string shell_word(const std::string& text) {
  const bool ordinary = !text.empty() && text.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_-+=./:,@%") == std::string::npos;
  if (ordinary) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string values_table(const Summary& summary) {
  std::vector<std::vector<std::string>> rows{{"name", "value"}};
  for (const Entry& one : summary) rows.push_back({one.name, value_text(one.value)});
  return table_html(rows);
}

std::vector<std::vector<std::string>> shown_rows(const Table& table) {
  std::vector<std::vector<std::string>> rows(table.rows() + 1);
  for (const std::string& column : table.columns()) {
    const bool place = is_place(column);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < table.rows(); ++i)
      texts.push_back(rounded_text(table.at(i, column), place ? 10 : 6));
    if (std::ranges::all_of(texts, [](const std::string& text) { return text.empty(); })) continue;
    rows[0].push_back(column);
    for (std::size_t i = 0; i < texts.size(); ++i) rows[i + 1].push_back(texts[i]);
  }
  return rows;
}

const Table* table_of(const Summary& summary, const std::string& name) {
  const auto* table = value_in<Table>(summary, name);
  return table == nullptr || table->empty() ? nullptr : table;
}

std::string files_list(const std::vector<RecordFile>& files) {
  std::string text = "<ul>\n<li><a href=\"summary.json\">summary.json</a>: all values</li>\n";
  for (const auto& file : files)
    if (!file.name.ends_with(".vtu"))
      text += fmt::format("<li><a href=\"{0}\">{0}</a>: {1}</li>\n", escaped(file.name), escaped(file.about));
  return text + "</ul>\n";
}

bool holds_file(const std::vector<RecordFile>& files, const std::string& name) {
  return std::ranges::any_of(files, [&](const RecordFile& file) { return file.name == name; });
}

std::string sentence(std::string about) { return capitalised(std::move(about)) + "."; }

std::string columns_html(const Table& table,
                         const std::vector<std::pair<std::string, std::string>>& columns) {
  std::vector<std::vector<std::string>> rows(1);
  for (const auto& [column, name] : columns) rows.front().push_back(name);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    rows.emplace_back();
    for (const auto& [column, name] : columns)
      rows.back().push_back(rounded_text(table.at(row, column), is_place(column) ? 6 : 3));
  }
  return table_html(rows, true);
}

std::string picture_html(const std::vector<RecordFile>& files, const std::string& stem,
                         const std::string& alternative, const std::string& caption) {
  FigureBlock block{stem};
  block.alternative = alternative;
  block.caption = escaped(caption);
  block.curves = holds_file(files, stem + ".figure.js");
  for (const RecordFile& file : files)
    if (file.name == stem + ".svg") block.size = picture_size(file.contents);
  return figure_html(block);
}

std::string pictures_html(const std::vector<RecordPicture>& pictures, const std::vector<RecordFile>& files) {
  std::string html;
  for (const RecordPicture& picture : pictures) {
    if (holds_file(files, picture.stem + ".svg"))
      html += picture_html(files, picture.stem, picture.about, sentence(picture.about));
  }
  const bool none_drawn = html.empty() && !pictures.empty();
  return none_drawn ? "<p>There is no picture: gnuplot was not found.</p>\n" : html;
}

std::string last_sections(const std::vector<std::string>& warnings, const std::string& asked,
                          const std::vector<RecordFile>& files, const Summary& summary) {
  return section_html("Warnings", warnings.empty() ? "" : list_html(warnings)) +
         section_html("The run", asked + folded("Files", files_list(files)) +
                                     folded("All values of the summary", values_table(summary)));
}

std::string report_page(PageParts page, const std::string& heading) {
  page.assets = "";
  page.libraries.insert(page.libraries.begin(), Library::d3);
  page.body = "<main>\n<h1>" + escaped(heading) + "</h1>\n" + page.body +
              fmt::format("<p class=\"quiet\">Wavebalance {}</p>\n</main>\n", version());
  return page_html(page);
}

void append_files(Summary& summary, const std::vector<RecordFile>& files) {
  summary.emplace_back("version", version());
  Table list({"name", "about"});
  for (const RecordFile& file : files) list.append_row({file.name, file.about});
  summary.emplace_back("files", std::move(list));
}

}  // namespace wavebalance::app
