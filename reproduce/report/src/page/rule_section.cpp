// The rule, how it came about, what is not judged, the misprints, and the table of all verdicts.
#include <fmt/format.h>

#include <algorithm>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {
namespace {

std::string folded(const std::string& summary, const std::vector<std::string>& heads, const std::string& rows,
                   const std::string& before = "") {
  std::string head;
  for (const auto& one : heads) head += "<th>" + one + "</th>";
  return fmt::format(
      "<details><summary>{}</summary>\n{}<div class=\"wide\"><table>\n<thead><tr>{}</tr></thead>\n<tbody>{}</tbody>"
      "</table></div></details>\n",
      summary, before, head, rows);
}

std::string cells(const std::vector<std::string>& texts) {
  std::string row = "<tr>";
  for (const auto& text : texts) row += "<td>" + app::with_formulas(text) + "</td>";
  return row + "</tr>\n";
}

std::string history_text(const std::vector<Found>& changed) {
  const auto before = std::count_if(changed.begin(), changed.end(), [](const Found& found) {
    return found.statement().earlier == not_judged;
  });
  return fmt::format(
      "<p>The rule was proposed by a review of an earlier version, which had judged each statement by a threshold of its "
      "own. The reviewer knew the figures of that version and named the verdicts to which the rule would lead. A second "
      "review then found “depends” where no reading agreed, readings that contradict the papers, axes that were not "
      "theirs, and misprints by decree. Sentences on these four points were added to the rule. Its three figures, {:g} %, "
      "{:g} % and a factor of {:g}, have not changed. The others had stood in single criteria, some with other values. Of the statements below, {} "
      "were judged by another criterion or had another verdict before, and {} were not judged.</p>\n",
      100.0 * tie_share, 100.0 * visible_share, similar_factor,
      static_cast<std::ptrdiff_t>(changed.size()) - before, before);
}

}  // namespace

std::string rule_html(const std::vector<Section>& sections) {
  const auto changed = all_statements(sections, [](const Statement& one) { return !one.earlier.empty(); });
  if (all_statements(sections, [](const Statement&) { return true; }).empty()) return "";
  std::string text = "<section id=\"rule\">\n<h2>The rule that decides</h2>\n<ul>\n";
  for (const auto& sentence : rule_text()) text += "<li>" + app::with_formulas(sentence) + "</li>\n";
  text += "</ul>\n";
  if (!changed.empty()) {
    std::string rows;
    for (const Found& found : changed)
      rows += fmt::format("<tr>{}<td>{}</td><td>{}</td></tr>\n", statement_cell(found),
                          app::with_formulas(found.statement().earlier), badge(found.statement()));
    text += folded("Criteria and verdicts that have changed", {"Figure", "The paper says", "Earlier", "Now"},
                   rows, history_text(changed));
  }
  return text + unjudged_html(sections) + misprints_html(sections) + "</section>\n";
}

std::string unjudged_html(const std::vector<Section>& sections) {
  std::string rows;
  int count = 0;
  for (const Section& section : sections)
    for (const Record& record : section.records)
      for (const Unjudged& one : record.unjudged) {
        rows += cells({section.paper.name + ", " + one.place, one.quote, one.reason, one.found});
        ++count;
      }
  if (count == 0) return "";
  return folded(fmt::format("{} that cannot be judged, with the reason",
                            count == 1 ? "One sentence" : fmt::format("{} sentences", count)),
                {"Where", "The paper says", "Why it is not judged", "Found"}, rows);
}

std::string misprints_html(const std::vector<Section>& sections) {
  std::string rows;
  int count = 0;
  for (const Section& section : sections)
    for (const Record& record : section.records) {
      for (const Statement& one : record.statements)
        if (one.verdict == Verdict::misprint) {
          rows += cells({section.paper.name + ", " + one.place, one.quote, one.measured, one.because});
          ++count;
        }
      for (const Slip& one : record.slips) {
        rows += cells({section.paper.name + ", " + one.place, one.printed, one.meant, one.shown});
        ++count;
      }
    }
  if (count == 0) return "";
  return folded(
      fmt::format("{} of the papers", count == 1 ? "One misprint" : fmt::format("All {} misprints", count)),
      {"Where", "Printed", "Meant, or found", "What shows it"}, rows);
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
