#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {
namespace {

std::string item(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, app::with_formulas(text));
}

std::string word(const Statement& one) {
  const auto text = of_text(one.readings);
  std::string words(to_string(one.verdict));
  if (text.size() > 1)
    words += fmt::format(": {} of {} interpretations", agreeing(one.readings), text.size());
  return words + (one.apart.empty() ? "" : " · " + one.apart + ", not counted");
}

std::string reading_table(const std::string& heading, const std::vector<Reading>& readings) {
  if (readings.empty()) return "";
  std::string rows;
  for (const Reading& reading : readings)
    rows +=
        fmt::format("<tr class=\"{}\"><td>{}</td><td>{}</td><td class=\"verdict\">{} {}</td></tr>\n",
                    kind(reading.verdict), app::with_formulas(reading.name),
                    app::with_formulas(reading.measured), sign(reading.verdict), to_string(reading.verdict));
  return table_of({heading, "Found", "Verdict"}, rows);
}

/// Criterion, finding unless the card shows it, and the verdict under each interpretation, folded.
std::string decided_html(const Statement& one) {
  const auto text = of_text(one.readings), beside = of_text(one.readings, false);
  return fmt::format(
      "<details class=\"readings\"><summary>How it is decided</summary>\n<p>{}</p>\n{}{}{}</details>\n",
      app::with_formulas(one.criterion),
      one.because.empty() ? "" : "<p>Found: " + app::with_formulas(one.measured) + "</p>\n",
      reading_table("Allowed by the text", text),
      reading_table(fmt::format("If instead ({} of {} agree)", agreeing(one.readings, false), beside.size()),
                    beside));
}

std::string where(const Statement& one) {
  std::string text = one.panel.empty() ? "" : "panel " + one.panel;
  if (!one.place.empty()) text += (text.empty() ? "" : ", ") + one.place;
  return app::escaped(text);
}

std::string card(const Record& record, std::size_t index) {
  const Statement& one = record.statements[index];
  const std::string id = anchor(record, index);
  return fmt::format(
      "<li class=\"card {0}\" id=\"{1}\">\n<p class=\"head\"><a href=\"#{1}\" aria-label=\"Link to statement {2}\">{2}"
      "</a> <span class=\"badge\">{3} {4}</span> <span class=\"quiet\">{5}</span></p>\n<blockquote>{6}</blockquote>\n"
      "<dl>\n{7}</dl>\n{8}</li>\n",
      kind(one.verdict), id, index + 1, sign(one.verdict), word(one), where(one),
      app::with_formulas(one.quote),
      one.because.empty() ? item("Found", one.measured) : item("Because", one.because), decided_html(one));
}

}  // namespace

std::string table_of(const std::vector<std::string>& heads, const std::string& rows) {
  return fmt::format(
      "<div class=\"wide\"><table>\n<thead><tr><th>{}</th></tr></thead>\n<tbody>{}</tbody></table></div>\n",
      fmt::join(heads, "</th><th>"), rows);
}

std::string folded(const std::string& summary, const std::vector<std::string>& heads, const std::string& rows,
                   const std::string& attributes) {
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", attributes, summary,
                     table_of(heads, rows));
}

std::string row_of(const std::vector<std::string>& texts) {
  std::string row = "<tr>";
  for (const auto& text : texts) row += "<td>" + app::with_formulas(text) + "</td>";
  return row + "</tr>\n";
}

std::string statements_html(const Record& record) {
  if (record.statements.empty()) return "";
  std::string text = "<h4>What the paper says</h4>\n<ol class=\"cards\">\n";
  for (std::size_t i = 0; i < record.statements.size(); ++i) text += card(record, i);
  return text + "</ol>\n";
}

std::string checks_html(const Record& record) {
  if (record.checks.empty()) return "";
  std::string rows;
  for (const Check& one : record.checks)
    rows += fmt::format("<tr><td>{}{}</td><td>{}</td><td>{}</td><td class=\"{} verdict\">{}</td></tr>\n",
                        app::with_formulas(one.sentence),
                        one.place.empty() ? "" : " (" + app::escaped(one.place) + ")",
                        app::with_formulas(one.criterion), app::with_formulas(one.measured),
                        one.passes ? "agrees" : "differs", one.passes ? "passes" : "fails");
  const auto count = record.checks.size();
  const auto failed =
      std::count_if(record.checks.begin(), record.checks.end(), [](const Check& c) { return !c.passes; });
  return folded(fmt::format("{} of the code, not counted: {}",
                            count == 1 ? "One check" : fmt::format("{} checks", count),
                            failed       ? fmt::format("{} of {} fail", failed, count)
                            : count == 1 ? "it passes"
                                         : "all pass"),
                {"Checked", "Decided by", "Found", ""}, rows,
                std::string(" class=\"checks\"") + (failed ? " open" : ""));
}

}  // namespace wavebalance::report
