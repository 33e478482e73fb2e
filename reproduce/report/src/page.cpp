#include "wavebalance/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wavebalance/app/files/output.hpp"

namespace wavebalance::report {
namespace {

const char* style = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1, h2, h3 { line-height: 1.25; }
h2 { border-bottom: 2px solid #ddd; padding-bottom: .2rem; margin-top: 3rem; }
section { margin: 2.5rem 0; }
img { max-width: 100%; height: auto; border: 1px solid #eee; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; margin: .8rem 0; }
div.wide { overflow-x: auto; }
th, td { text-align: left; vertical-align: top; padding: .35rem .6rem; border-top: 1px solid #ddd; }
th { background: #f6f6f6; }
q { font-style: italic; }
.place, .files, .note { color: #555; font-size: .88rem; }
.verdict { white-space: nowrap; font-weight: 600; }
.agrees { color: #00684a; }
.differs { color: #a03c00; }
nav a { margin-right: .8rem; white-space: nowrap; }
)";

/// A sentence, what decides, what was found, and the verdict, one row for each.
std::string row(const std::string& sentence, const std::string& place, const std::string& criterion,
                const std::string& measured, const char* kind, std::string_view verdict) {
  return fmt::format(
      "<tr><td><q>{}</q> <span class=\"place\">({})</span></td><td>{}</td><td>{}</td><td class=\"verdict "
      "{}\">{}</td></tr>\n",
      escaped(sentence), escaped(place), escaped(criterion), escaped(measured), kind, verdict);
}

const char* kind(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "differs";
    case Verdict::partly:
      return "partly";
    case Verdict::misprint:
      return "misprint";
    case Verdict::depends:
      return "depends";
  }
  return "";
}

std::string table_of(const std::string& rows, const char* who) {
  if (rows.empty()) return "";
  return std::string("<div class=\"wide\"><table><tr><th>") + who +
         "</th><th>Measured, and what decides</th><th>Found in this run</th><th></th></tr>\n" + rows +
         "</table></div>\n";
}

std::string statements_table(const std::vector<Statement>& statements) {
  std::string rows;
  for (const Statement& one : statements)
    rows += row(one.quote, one.place, one.criterion, one.measured, kind(one.verdict), to_string(one.verdict));
  return table_of(rows, "The paper says");
}

std::string checks_table(const std::vector<Check>& checks) {
  std::string rows;
  for (const Check& one : checks)
    rows += row(one.sentence, one.place, one.criterion, one.measured, one.passes ? "agrees" : "differs",
                one.passes ? "passes" : "fails");
  return table_of(rows, "Check");
}

std::string table_row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const auto& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return text + "</tr>\n";
}

std::string data_table(const TextTable& table) {
  if (table.empty()) return "";
  std::string text = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < table.size(); ++i) text += table_row(table[i], i == 0 ? "th" : "td");
  return text + "</table></div>\n";
}

/// `folder` is that of the results as seen from the page: "extremes/", or empty on a page beside them.
std::string picture(const Record& record, const std::string& folder) {
  const std::string svg = record.identity.stem + ".svg", png = record.identity.stem + ".png";
  if (std::find(record.files.begin(), record.files.end(), svg) == record.files.end()) return "";
  return fmt::format("<a href=\"{0}{1}\"><img src=\"{0}{2}\" alt=\"{3}\" loading=\"lazy\"></a>\n", folder,
                     svg, png, escaped(record.identity.number + ": " + record.identity.title));
}

std::string origins(const Record& record, const std::string& folder) {
  std::string text = "<p class=\"files\">";
  for (const auto& file : record.files)
    text += fmt::format("<a href=\"{0}{1}\">{1}</a> ", folder, escaped(file));
  if (!record.scenes.empty()) {
    text += "· scenes:";
    for (const auto& scene : record.scenes) text += " " + escaped(scene.name);
  }
  return text + fmt::format(" · {:.2f} s</p>\n", record.wall_seconds);
}

std::string artefact_section(const Record& record, const std::string& folder) {
  std::string text = fmt::format("<section id=\"{}\">\n<h3>{}: {}</h3>\n", record.identity.stem,
                                 escaped(record.identity.number), escaped(record.identity.title));
  text += picture(record, folder) + "<p>" + escaped(record.caption) + "</p>\n" + data_table(record.table);
  text += statements_table(record.statements) + checks_table(record.checks);
  for (const auto& note : record.notes) text += "<p class=\"note\">" + escaped(note) + "</p>\n";
  return text + origins(record, folder) + "</section>\n";
}

std::string not_agreeing(const Section& section) {
  std::string rows;
  for (const Record& record : section.records)
    for (const Statement& one : record.statements)
      if (one.verdict != Verdict::agrees)
        rows += fmt::format(
            "<tr><td><a href=\"#{}\">{}</a></td><td><q>{}</q> <span "
            "class=\"place\">({})</span></td><td>{}</td><td class=\"verdict {}\">{}</td></tr>\n",
            record.identity.stem, escaped(record.identity.number), escaped(one.quote), escaped(one.place),
            escaped(one.because), kind(one.verdict), to_string(one.verdict));
  if (rows.empty()) return "";
  return "<h3>Statements that do not agree</h3>\n"
         "<div class=\"wide\"><table><tr><th></th><th>The paper says</th><th>Because</th><th></th></tr>\n" +
         rows + "</table></div>\n";
}

std::string overview(const Section& section) {
  int statements = 0, agreeing = 0;
  double seconds = 0.0;
  std::string links;
  for (const Record& record : section.records) {
    seconds += record.wall_seconds;
    links += fmt::format("<a href=\"#{}\">{}</a>\n", record.identity.stem, escaped(record.identity.number));
    for (const Statement& one : record.statements) {
      ++statements;
      agreeing += one.verdict == Verdict::agrees ? 1 : 0;
    }
  }
  if (statements == 0) return fmt::format("<nav>{}</nav>\n", links);
  return fmt::format(
      "<p>{} figures, tables and references in {:.1f} s of computing. Of {} statements of the paper <span "
      "class=\"verdict agrees\">{} agree</span>.</p>\n<nav>{}</nav>\n",
      section.records.size(), seconds, statements, agreeing, links);
}

std::string paper_section(const Section& section, const std::string& folder) {
  std::string text = fmt::format("<h2>{}</h2>\n", escaped(section.paper.citation));
  if (!section.paper.link.empty())
    text += fmt::format(
        "<p class=\"place\">Text: <a href=\"{}\">{}</a>. Sentences are quoted from it under {}.</p>\n",
        section.paper.link, escaped(section.paper.link), escaped(section.paper.licence));
  text += overview(section) + not_agreeing(section);
  for (const Record& record : section.records) text += artefact_section(record, folder);
  return text;
}

/// The captions of a section that has its own page, and the link to it.
std::string linked_section(const Section& section) {
  std::string text = fmt::format("<h2>{}</h2>\n", escaped(section.paper.citation));
  for (const Record& record : section.records)
    text += fmt::format("<p><a href=\"{}/index.html#{}\">{}: {}</a>. {}</p>\n", section.paper.folder,
                        record.identity.stem, escaped(record.identity.number), escaped(record.identity.title),
                        escaped(record.caption));
  return text;
}

std::string html(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n<style>{}</style>\n</head>\n"
      "<body>\n{}</body>\n</html>\n",
      escaped(title), style, body);
}

}  // namespace

const std::vector<Paper>& papers() {
  static const std::vector<Paper> all{
      {"jones_legrand_2014",
       "Jones & Legrand 2014, Vibrations of an axial bar experiencing periodic unilateral contact using the "
       "wavelet balance method",
       "https://hal.science/hal-01403614", "CC BY 4.0"},
      {"laxalde_legrand_2010",
       "Laxalde & Legrand 2010, Nonlinear modal analysis of mechanical systems with frictionless contact "
       "interfaces (preprint, version 1)",
       "https://hal.science/hal-00492775", "the right of quotation"},
      {"blade", "The blade further: beyond the papers", "", ""},
      {"cases_of_others",
       "Cases of others: curves that other programs publish or whose special points are known exactly", "",
       "", true},
      {"extremes", "Extremes: inputs at the edge of what numbers, structures and bases can be", "", "", true},
  };
  return all;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string page_html(const std::vector<Section>& sections) {
  std::string body = fmt::format(
      "<h1>Wavebalance: papers regenerated</h1>\n"
      "<p>Every figure and table below was computed from scene files by Wavebalance {}. Each statement of a paper stands "
      "beside the values of this run; the verdict is computed from them by the threshold that is given.</p>\n",
      app::version());
  for (const Section& section : sections)
    body +=
        section.paper.own_page ? linked_section(section) : paper_section(section, section.paper.folder + "/");
  return html("Wavebalance: results", body);
}

std::string own_page_html(const Section& section) {
  return html("Wavebalance: " + section.paper.folder,
              "<p><a href=\"../index.html\">All results</a></p>\n" + paper_section(section, ""));
}

}  // namespace wavebalance::report
