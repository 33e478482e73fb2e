#include <fmt/format.h>

#include <algorithm>

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
  return app::figure_html(
      {place.folder + stem, small ? ".svg" : ".png", record.identity.number + ": " + record.identity.title,
       app::with_formulas(record.caption), place.section.files.count(stem + ".figure.js") > 0});
}

std::string notes(const Record& record) {
  if (record.notes.empty()) return "";
  std::string text = "<ul class=\"notes\">\n";
  for (const auto& note : record.notes) text += "<li>" + app::with_formulas(note) + "</li>\n";
  return text + "</ul>\n";
}

}  // namespace

std::string artefact_html(const Record& record, const Place& place) {
  const std::string image = picture(record, place);
  std::string shown = image.empty() ? "<p>" + app::with_formulas(record.caption) + "</p>\n" : image;
  shown += app::table_html(record.table) + theirs(record, place.section.paper) + notes(record) +
           origin_html(record, place);
  const std::string said = statements_html(record);
  const std::string checks = checks_html(record);
  return fmt::format(
      "<section class=\"artefact\" id=\"{}\">\n<h3>{}: {}</h3>\n<div class=\"{}\">\n<div class=\"shown\">\n{}</div>\n"
      "<div class=\"said\">\n{}{}</div>\n</div>\n{}</section>\n",
      record.identity.stem, app::escaped(record.identity.number), app::escaped(record.identity.title),
      said.empty() ? "alone" : "beside", shown, said, checks, moving_html(record, place));
}

}  // namespace wavebalance::report
