// The rule, what is not judged, the misprints, and the table of all verdicts.
#include <fmt/format.h>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {
namespace {

/// The rows of a table with their number in its summary.
struct Rows {
  std::string text;
  int count = 0;

  void add(const Section& section, const std::string& place, const std::string& first,
           const std::string& second, const std::string& third) {
    text += row_of({section.paper.name + ", " + place, first, second, third});
    ++count;
  }
};

std::string unjudged_html(const std::vector<Section>& sections) {
  Rows rows;
  for (const Section& section : sections)
    for (const Record& record : section.records)
      for (const Unjudged& one : record.unjudged)
        rows.add(section, one.place, one.quote, one.reason, one.found);
  if (rows.count == 0) return "";
  return folded(fmt::format("{} that cannot be judged, with the reason",
                            rows.count == 1 ? "One sentence" : fmt::format("{} sentences", rows.count)),
                {"Where", "The paper says", "Why it is not judged", "Found"}, rows.text);
}

std::string misprints_html(const std::vector<Section>& sections) {
  Rows rows;
  for (const Section& section : sections)
    for (const Record& record : section.records) {
      for (const Statement& one : record.statements)
        if (one.verdict == Verdict::misprint)
          rows.add(section, one.place, one.quote, one.measured, one.because);
      for (const Slip& one : record.slips) rows.add(section, one.place, one.printed, one.meant, one.shown);
    }
  if (rows.count == 0) return "";
  return folded(fmt::format("{} of the papers",
                            rows.count == 1 ? "One misprint" : fmt::format("All {} misprints", rows.count)),
                {"Where", "Printed", "Meant, or found", "What shows it"}, rows.text);
}

}  // namespace

std::string rule_html(const std::vector<Section>& sections) {
  if (all_statements(sections, [](const Statement&) { return true; }).empty()) return "";
  std::string text = "<section id=\"rule\">\n<h2>The rule that decides</h2>\n<ul>\n";
  for (const auto& sentence : rule_text()) text += "<li>" + app::with_formulas(sentence) + "</li>\n";
  text += "</ul>\n";
  return text + unjudged_html(sections) + misprints_html(sections) + "</section>\n";
}

app::Table verdicts_table(const std::vector<Section>& sections) {
  app::Table table({"id", "paper", "figure", "place", "sentence", "verdict", "counted", "readings_of_text",
                    "agreeing_of_text", "readings_if_instead", "agreeing_if_instead", "criterion", "found",
                    "because"});
  const auto size = [](const std::vector<Reading>& readings) {
    return static_cast<std::int64_t>(readings.size());
  };
  for (const Found& found : all_statements(sections, [](const Statement&) { return true; })) {
    const Statement& one = found.statement();
    table.append_row({anchor(found.record, found.index), found.section.paper.folder,
                      found.record.identity.number, one.place, one.quote, std::string(to_string(one.verdict)),
                      one.apart.empty(), size(of_text(one.readings)), std::int64_t{agreeing(one.readings)},
                      size(of_text(one.readings, false)), std::int64_t{agreeing(one.readings, false)},
                      one.criterion, one.measured, one.because});
  }
  return table;
}

}  // namespace wavebalance::report
