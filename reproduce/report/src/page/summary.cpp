#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {
namespace {

constexpr std::size_t most_differing = 4, most_depending = 2;  // lines of the ten

/// A statement and where it stands.
struct Found {
  const Section& section;
  const Record& record;
  std::size_t index;

  const Statement& statement() const { return record.statements[index]; }
};

std::vector<Found> all_statements(const std::vector<Section>& sections,
                                  const std::function<bool(const Statement&)>& wanted) {
  std::vector<Found> found;
  for (const Section& section : sections) {
    if (section.paper.own_page) continue;
    for (const Record& record : section.records)
      for (std::size_t i = 0; i < record.statements.size(); ++i)
        if (wanted(record.statements[i])) found.push_back({section, record, i});
  }
  return found;
}

std::vector<Found> with_verdict(const std::vector<Section>& sections, Verdict verdict) {
  return all_statements(sections, [&](const Statement& one) { return one.verdict == verdict; });
}

Tally tally_of(const Section& section) {
  Tally tally;
  for (const Record& record : section.records) tally.add(record);
  return tally;
}

std::string link(const Found& found) {
  return fmt::format("<a href=\"#{}\">{}</a>", anchor(found.record, found.index),
                     app::escaped(found.record.identity.number));
}

std::string badge(const Statement& one) {
  return fmt::format("<span class=\"badge {}\">{} {}</span>", kind(one.verdict),
                     sign(one.verdict, one.readings), to_string(one.verdict));
}

std::string first_sentence(const std::string& text) {
  const std::size_t end = text.find(". ");
  return shortened(end == text.npos ? text : text.substr(0, end + 1), 220);
}

/// "JL14 Fig. 4: “...” differs, because ..."
std::string reason_line(const Found& found) {
  const Statement& one = found.statement();
  return fmt::format("<li>{} {}: <q>{}</q> {}</li>\n", badge(one), link(found),
                     app::with_formulas(shortened(one.quote, 120)),
                     app::with_formulas(first_sentence(one.because)));
}

std::string reason_lines(const std::vector<Found>& list, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i) text += reason_line(list[i]);
  return text;
}

/// The artefacts of a section of which all statements agree: "Figs. 2, 5".
std::string whole_artefacts(const Section& section) {
  std::vector<std::string> names;
  for (const Record& record : section.records) {
    Tally tally;
    tally.add(record);
    if (tally.all() > 0 && tally.of(Verdict::agrees) == tally.all())
      names.push_back(fmt::format("<a href=\"#{}\">{}</a>", record.identity.stem,
                                  app::escaped(short_number(record, section.paper))));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string paper_line(const Section& section) {
  const Tally tally = tally_of(section);
  const std::string whole = whole_artefacts(section);
  return fmt::format("<li><a href=\"#{}\">{}</a>: of {} {} {}.{}</li>\n", section.paper.folder,
                     app::escaped(section.paper.name), tally.all(),
                     tally.all() == 1 ? "statement" : "statements", tally_text(tally),
                     whole.empty() ? "" : " All agree at " + whole + ".");
}

std::string cell(const Record& record, std::size_t index) {
  const Statement& one = record.statements[index];
  return fmt::format(
      "<a class=\"cell {}\" href=\"#{}\" title=\"{}\" aria-label=\"{}, statement {}: {}\">{}</a>",
      kind(one.verdict), anchor(record, index), app::escaped(shortened(one.quote, 200)),
      app::escaped(record.identity.number), index + 1, to_string(one.verdict),
      sign(one.verdict, one.readings));
}

/// What the lines before leave out, figure by figure.
std::string rest_line(const std::vector<Section>& sections) {
  std::vector<Found> left;
  const auto add = [&](Verdict verdict, std::size_t shown) {
    const auto list = with_verdict(sections, verdict);
    for (std::size_t i = shown; i < list.size(); ++i) left.push_back(list[i]);
  };
  add(Verdict::differs, most_differing);
  add(Verdict::depends, most_depending);
  add(Verdict::partly, 0);
  add(Verdict::misprint, 0);
  std::string text;
  for (const Section& section : sections)
    for (const Record& record : section.records) {
      std::string cells;
      for (const Found& found : left)
        if (&found.record == &record) cells += " " + cell(record, found.index);
      if (!cells.empty()) text += (text.empty() ? "" : ", ") + app::escaped(record.identity.number) + cells;
    }
  return text.empty() ? "" : "<li>Further statements that do not simply agree: " + text + ".</li>\n";
}

std::string matrix_rows(const Section& section) {
  std::string rows;
  for (const Record& record : section.records) {
    if (record.statements.empty()) continue;
    std::string cells;
    for (std::size_t i = 0; i < record.statements.size(); ++i) cells += cell(record, i) + "\n";
    rows += fmt::format("<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th><td>{}</td></tr>\n",
                        record.identity.stem, app::escaped(short_number(record, section.paper)), cells);
  }
  return rows;
}

std::string key_of_signs() {
  std::string text = "<p class=\"key\">";
  for (const Verdict verdict : all_verdicts)
    text += fmt::format("<span class=\"badge {}\">{} {}</span> ", kind(verdict),
                        verdict == Verdict::depends ? "k/n" : sign(verdict), to_string(verdict));
  return text +
         "<span class=\"quiet\">k/n: agrees under k of n readings of what the paper leaves open</span></p>\n";
}

std::string statement_cell(const Found& found) {
  return fmt::format("<td>{}</td><td><q>{}</q></td>", link(found),
                     app::with_formulas(found.statement().quote));
}

}  // namespace

std::string brief_html(const std::vector<Section>& sections) {
  Tally total;
  std::string lines;
  for (const Section& section : sections) {
    const Tally tally = tally_of(section);
    if (section.paper.own_page || tally.all() == 0) continue;
    for (const Record& record : section.records) total.add(record);
    lines += paper_line(section);
  }
  if (total.all() == 0) return "";
  return fmt::format(
      "<section id=\"brief\">\n<h2>What holds, what does not, and why</h2>\n<ul class=\"brief\">\n"
      "<li>Of {} statements {}. Checks of the code are not counted.</li>\n{}{}{}{}</ul>\n{}</section>\n",
      total.all(), tally_text(total), lines,
      reason_lines(with_verdict(sections, Verdict::differs), most_differing),
      reason_lines(with_verdict(sections, Verdict::depends), most_depending), rest_line(sections),
      not_agreeing_html(sections));
}

std::string not_agreeing_html(const std::vector<Section>& sections) {
  const auto list =
      all_statements(sections, [](const Statement& one) { return one.verdict != Verdict::agrees; });
  if (list.empty()) return "";
  std::string rows;
  for (const Found& found : list) {
    const Statement& one = found.statement();
    rows += fmt::format("<tr>{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", statement_cell(found),
                        app::with_formulas(one.criterion), app::with_formulas(one.measured),
                        app::with_formulas(one.because), badge(one));
  }
  return fmt::format(
      "<details><summary>All {} statements that do not simply agree, with reasons</summary>\n<div class=\"wide\""
      "><table>\n<thead><tr><th>Figure</th><th>The paper says</th><th>Decided by</th><th>Found</th>"
      "<th>Because</th><th>Verdict</th></tr></thead>\n<tbody>{}</tbody></table></div></details>\n",
      list.size(), rows);
}

std::string matrix_html(const std::vector<Section>& sections) {
  std::string tables;
  for (const Section& section : sections) {
    const std::string rows = section.paper.own_page ? "" : matrix_rows(section);
    if (!rows.empty())
      tables += fmt::format("<table class=\"matrix\"><caption>{}</caption>\n<tbody>{}</tbody></table>\n",
                            app::escaped(section.paper.name), rows);
  }
  if (tables.empty()) return "";
  return "<section id=\"matrix\">\n<h2>Every statement at a glance</h2>\n" + key_of_signs() +
         "<div class=\"matrices\">\n" + tables + "</div>\n</section>\n";
}

std::string rule_html(const std::vector<Section>& sections) {
  const auto changed = all_statements(sections, [](const Statement& one) { return !one.earlier.empty(); });
  if (all_statements(sections, [](const Statement&) { return true; }).empty()) return "";
  std::string text = "<section id=\"rule\">\n<h2>The rule that decides</h2>\n<ul>\n";
  for (const auto& sentence : rule_text()) text += "<li>" + app::with_formulas(sentence) + "</li>\n";
  text += "</ul>\n";
  if (changed.empty()) return text + "</section>\n";
  std::string rows;
  for (const Found& found : changed)
    rows += fmt::format("<tr>{}<td>{}</td><td>{}</td></tr>\n", statement_cell(found),
                        app::with_formulas(found.statement().earlier), badge(found.statement()));
  return text +
         fmt::format(
             "<p>The rule was written down before the verdicts on this page were computed. Earlier versions "
             "judged each statement by a threshold of its own, some of which were changed after first results "
             "had been seen. For {} statements the criterion or the verdict was another one.</p>\n"
             "<details><summary>Criteria and verdicts that have changed</summary>\n<div class=\"wide\">"
             "<table>\n<thead><tr><th>Figure</th><th>The paper says</th><th>Earlier</th><th>Now</th></tr></thead>\n"
             "<tbody>{}</tbody></table></div></details>\n</section>\n",
             changed.size(), rows);
}

}  // namespace wavebalance::report
