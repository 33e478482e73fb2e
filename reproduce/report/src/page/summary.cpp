#include <fmt/format.h>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {

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

namespace {

bool counted(const Statement& one) { return one.apart.empty(); }

/// A link to a statement that shows the number of its figure.
std::string link(const Found& found) {
  return fmt::format("<a href=\"#{}\">{}</a>", anchor(found.record, found.index),
                     app::escaped(found.record.identity.number));
}

/// Sign and word of a verdict in its colour.
std::string badge(const Statement& one) {
  return fmt::format("<span class=\"badge {}\">{} {}</span>", kind(one.verdict),
                     sign(one.verdict, one.readings), to_string(one.verdict));
}

/// All statements that do not agree.
std::string not_agreeing_html(const std::vector<Section>& sections) {
  const auto list =
      all_statements(sections, [](const Statement& one) { return one.verdict != Verdict::agrees; });
  if (list.empty()) return "";
  std::string rows;
  for (const Found& found : list) {
    const Statement& one = found.statement();
    rows +=
        fmt::format("<tr><td>{}</td><td><q>{}</q></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                    link(found), app::with_formulas(one.quote), app::with_formulas(one.criterion),
                    app::with_formulas(one.measured), app::with_formulas(one.because), badge(one));
  }
  return folded(fmt::format("All {} statements that do not simply agree, with reasons", list.size()),
                {"Figure", "The paper says", "Decided by", "Found", "Because", "Verdict"}, rows);
}

/// The findings of statements that agree, or of the others.
std::string headlines(const std::vector<Section>& sections, bool agrees, std::size_t most) {
  const auto list = all_statements(sections, [&](const Statement& one) {
    return counted(one) && !one.headline.empty() && (one.verdict == Verdict::agrees) == agrees;
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i)
    text += fmt::format("<li>{} <b>{}:</b> {} {}</li>\n", badge(list[i].statement()),
                        app::with_formulas(list[i].statement().claim),
                        app::with_formulas(list[i].statement().headline), link(list[i]));
  return text;
}

/// "44 of 66 statements agree, ..."
std::string counts_text(const std::vector<Section>& sections) {
  Tally total;
  for (const Section& section : sections)
    if (!section.paper.own_page)
      for (const Record& record : section.records) total.add(record);
  return fmt::format("Of {} statements {}.", total.all(), tally_text(total));
}

std::string title_of(const Statement& one) {
  std::string text = shortened(one.quote, 200);
  const auto beside = of_text(one.readings, false).size();
  if (beside > 0) text += fmt::format(" · if instead: {} of {} agree", agreeing(one.readings, false), beside);
  return text + (one.apart.empty() ? "" : " · " + one.apart);
}

std::string cell(const Record& record, std::size_t index) {
  const Statement& one = record.statements[index];
  return fmt::format(
      "<a class=\"cell {}{}\" href=\"#{}\" title=\"{}\" aria-label=\"{}, statement {}: {}\">{}</a>",
      kind(one.verdict), counted(one) ? "" : " apart", anchor(record, index), app::escaped(title_of(one)),
      app::escaped(record.identity.number), index + 1, to_string(one.verdict),
      sign(one.verdict, one.readings));
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

std::string key_of_signs(const std::vector<Section>& sections) {
  std::string text = "<p class=\"key\">";
  for (const Verdict verdict : all_verdicts)
    text += fmt::format("<span class=\"badge {}\">{} {}</span> ", kind(verdict),
                        verdict == Verdict::depends ? "k/n" : sign(verdict), to_string(verdict));
  text += "<span class=\"quiet\">k/n: agrees under k of the n interpretations that the paper's text allows";
  const auto apart = all_statements(sections, [](const Statement& one) { return !counted(one); });
  if (!apart.empty())
    text += fmt::format("; dashed: {}, not counted", app::escaped(apart.front().statement().apart));
  return text + "</span></p>\n";
}

}  // namespace

std::string brief_html(const std::vector<Section>& sections) {
  if (all_statements(sections, counted).empty()) return "";
  const std::string agreeing = headlines(sections, true, most_agreeing),
                    others = headlines(sections, false, most_others);
  return fmt::format(
      "<section id=\"brief\">\n<h2>What holds, and what does not</h2>\n<p>{}</p>\n{}{}</section>\n",
      counts_text(sections),
      agreeing.empty() && others.empty() ? "" : "<ul class=\"brief\">\n" + agreeing + others + "</ul>\n",
      not_agreeing_html(sections));
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
  return "<section id=\"matrix\">\n<h2>Every statement at a glance</h2>\n" + key_of_signs(sections) +
         "<div class=\"matrices\">\n" + tables +
         "</div>\n<p class=\"quiet\">All of them with their criteria and findings are in <a "
         "href=\"verdicts.csv\">verdicts.csv</a>.</p>\n</section>\n";
}

}  // namespace wavebalance::report
