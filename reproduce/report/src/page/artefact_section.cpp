#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"

namespace wavebalance::report {
namespace {

constexpr std::uintmax_t largest_svg =
    500'000;  // bytes; larger ones are slow to draw, so that the PNG is shown

std::uintmax_t bytes(const Section& section, const std::string& file) {
  const auto found = section.files.find(file);
  return found == section.files.end() ? 0 : found->second;
}

/// The paper's own figure cannot be shown; its number and its page are.
std::string theirs(const Record& record, const Paper& paper) {
  const std::string number = short_number(record, paper);
  if (paper.link.empty() || !(number.starts_with("Fig.") || number.starts_with("Table"))) return "";
  const std::string its = number.substr(0, number.find(','));
  return fmt::format("<p class=\"quiet\">The paper's own {}: <a href=\"{}\">{}</a></p>\n", app::escaped(its),
                     app::escaped(paper.link), app::escaped(paper.name));
}

std::string picture(const Record& record, const Place& place) {
  const std::string& stem = record.identity.stem;
  const auto& files = record.files;
  if (std::find(files.begin(), files.end(), stem + ".svg") == files.end()) return "";
  const bool small = bytes(place.section, stem + ".svg") <= largest_svg;
  const std::string suffix = small ? ".svg" : ".png";
  const auto& sizes = place.section.sizes;
  const auto size = sizes.find(stem + suffix);
  std::string alternative = record.identity.number + ": " + record.identity.title + ". " + record.caption;
  std::erase_if(alternative,
                [](char c) { return std::string_view("$\\{}").find(c) != std::string_view::npos; });
  return app::figure_html({place.folder + stem, suffix, alternative, app::with_formulas(record.caption),
                           place.section.files.count(stem + ".figure.js") > 0,
                           size == sizes.end() ? "" : size->second});
}

std::string notes(const Record& record) {
  if (record.notes.empty()) return "";
  std::string text = "<details class=\"more\"><summary>Notes</summary>\n<ul class=\"notes\">\n";
  for (const auto& note : record.notes) text += "<li>" + app::with_formulas(note) + "</li>\n";
  return text + "</ul>\n</details>\n";
}

/// Links from a figure to what can be moved below it.
std::string ways_on(const std::string& readings, const std::string& moving, const std::string& stem) {
  std::string text;
  if (!readings.empty()) text += fmt::format("<a href=\"#sums-{}\">Other sums ↓</a> ", stem);
  if (!moving.empty()) text += fmt::format("<a href=\"#move-{}\">See it move ↓</a>", stem);
  return text.empty() ? "" : "<p class=\"quiet ways-on\">" + text + "</p>\n";
}

/// Choices of how the sums are formed, where an artefact has left their curves.
std::string sums_html(const Record& record, const Place& place) {
  const std::string script = record.identity.stem + ".readings.js";
  if (place.section.files.count(script) == 0) return "";
  return fmt::format("<div class=\"sums\" id=\"sums-{}\" data-readings=\"{}{}\"></div>\n",
                     record.identity.stem, place.folder, app::escaped(script));
}

/// A table whose heads may be broken between the words of a column's name.
std::vector<std::vector<std::string>> with_blanks(std::vector<std::vector<std::string>> table) {
  if (!table.empty())
    for (std::string& head : table.front())
      if (head.find('$') == head.npos) std::replace(head.begin(), head.end(), '_', ' ');
  return table;
}

/// The table of a record, folded if it is long, except on a separate page.
std::string table(const Record& record, const Place& place) {
  constexpr std::size_t long_table = 9;
  const std::string text = app::table_html(with_blanks(record.table));
  if (record.table.size() < long_table || place.section.paper.own_page) return text;
  return fmt::format("<details><summary>Table of {} rows</summary>\n{}</details>\n", record.table.size() - 1,
                     text);
}

}  // namespace

std::string artefact_html(const Record& record, const Place& place) {
  const std::string image = picture(record, place), said = statements_html(record),
                    sums = sums_html(record, place), moving = moving_html(record, place);
  std::string shown = image.empty() ? "<p>" + app::with_formulas(record.caption) + "</p>\n" : image;
  shown += table(record, place) + ways_on(sums, moving, record.identity.stem);
  const std::string more =
      checks_html(record) + notes(record) + theirs(record, place.section.paper) + origin_html(record, place);
  return fmt::format(
      "<section class=\"artefact\" id=\"{0}\">\n<h3>{1}: {2}</h3>\n<div class=\"{3}\">\n<div class=\"shown\">\n{4}</div>\n"
      "<div class=\"said\">\n{5}</div>\n</div>\n{6}{7}{8}</section>\n",
      record.identity.stem, app::escaped(record.identity.number), app::escaped(record.identity.title),
      said.empty() ? "alone" : "beside", shown, said, sums,
      moving.empty() ? "" : fmt::format("<div id=\"move-{}\">\n{}</div>\n", record.identity.stem, moving),
      more);
}

}  // namespace wavebalance::report
