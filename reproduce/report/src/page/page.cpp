#include "wavebalance/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "page/page_parts.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/page/html.hpp"

namespace wavebalance::report {
namespace {

constexpr const char* bench_page = "bench/index.html";

/// "✓5 ✗1", each with its colour.
std::string small_tally(const Record& record) {
  Tally tally;
  tally.add(record);
  std::string text;
  for (const Verdict verdict : all_verdicts)
    if (tally.of(verdict) > 0)
      text += fmt::format(" <span class=\"verdict {}\" title=\"{}\">{}{}</span>", kind(verdict),
                          to_string(verdict), sign(verdict), tally.of(verdict));
  return text;
}

std::string entry(const std::string& target, const std::string& name, const std::string& more = "") {
  return fmt::format("<li><a href=\"{}\">{}</a>{}</li>\n", target, name, more);
}

std::string records_contents(const Section& section) {
  std::string text = "<ol>\n";
  for (const Record& record : section.records)
    text += entry("#" + record.identity.stem,
                  fmt::format("<b>{}</b> {}", app::escaped(short_number(record, section.paper)),
                              app::escaped(record.identity.title)),
                  small_tally(record));
  return text + "</ol>\n";
}

std::string contents_box(const std::string& entries) {
  return "<nav class=\"contents\" aria-label=\"Contents\">\n<details open><summary>Contents</summary>\n<ol>\n" +
         entries + "</ol>\n</details>\n</nav>\n";
}

std::string contents(const std::vector<Section>& sections, bool judged, bool measured) {
  std::string text;
  if (judged)
    text += entry("#brief", "What holds, what does not") + entry("#matrix", "Every statement at a glance") +
            entry("#rule", "The rule that decides");
  for (const Section& section : sections) {
    const std::string name = app::escaped(section.paper.name);
    if (section.paper.own_page)
      text += entry(section.paper.folder + "/index.html", name + " →");
    else
      text += fmt::format("<li><a href=\"#{}\">{}</a>\n{}</li>\n", section.paper.folder, name,
                          records_contents(section));
  }
  return contents_box(text + (measured ? entry(bench_page, "Speed against accuracy →") : ""));
}

std::string totals(const Section& section) {
  double seconds = 0.0;
  for (const Record& record : section.records) seconds += record.wall_seconds;
  const auto count = section.records.size();
  return fmt::format("{} {}, {:.1f} s of computing", count, count == 1 ? "result" : "results", seconds);
}

/// The citation; on a separate page only its part after the name, which is the heading of the page.
std::string heading_of(const Paper& paper) {
  const std::string name = paper.name + ": ";
  if (!paper.own_page || !paper.citation.starts_with(name)) return paper.citation;
  std::string text = paper.citation.substr(name.size());
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string section_html(const Place& place) {
  const Section& section = place.section;
  const Paper& paper = section.paper;
  std::string text = fmt::format("<h2 id=\"{}\">{}</h2>\n<p class=\"quiet\">{}.", paper.folder,
                                 app::escaped(heading_of(paper)), totals(section));
  if (!paper.link.empty())
    text += fmt::format(" The paper: <a href=\"{0}\">{0}</a>. Sentences are quoted from it under {1}.",
                        app::escaped(paper.link), app::escaped(paper.licence));
  text += "</p>\n";
  for (const Record& record : section.records) text += artefact_html(record, place);
  return text;
}

/// Content of a separate page, and the link to it.
std::string linked_section(const Section& section) {
  const Paper& paper = section.paper;
  return fmt::format("<h2 id=\"{0}\">{1}</h2>\n<p><a href=\"{0}/index.html\">{2}</a>: {3}.</p>\n",
                     paper.folder, app::escaped(paper.citation), app::escaped(paper.name), totals(section));
}

std::string layout(const std::string& menu, const std::string& main) {
  return "<a class=\"skip\" href=\"#main\">Skip the contents</a>\n<div class=\"layout\">\n" + menu +
         "<main id=\"main\">\n" + main + "</main>\n</div>\n";
}

app::PageParts parts(const std::string& title, const std::string& assets, const std::string& body) {
  app::PageParts page;
  page.title = title;
  page.body = body;
  page.assets = assets;
  page.libraries = {app::Library::katex, app::Library::d3};
  if (body.find("class=\"motion\"") != body.npos) page.scripts.push_back("motion.js");
  if (body.find("class=\"sums\"") != body.npos) page.scripts.push_back("sums.js");
  if (body.find("class=\"body-motion\"") != body.npos) page.scripts.push_back("body.js");
  return page;
}

}  // namespace

std::string page_html(const std::vector<Section>& sections, const Origin& origin, bool measured) {
  const std::string brief = brief_html(sections);
  std::string main = fmt::format(
      "<h1>Two papers, reproduced and checked</h1>\n<p>Sentences and not curves are compared, because the data of the "
      "papers' curves are not published. Wavebalance {} computed all figures and tables again. Beside each "
      "are the sentences on it, the value found and the verdict of <a href=\"#rule\">one rule</a>.</p>\n",
      app::version());
  main += brief + matrix_html(sections) + rule_html(sections);
  for (const Section& section : sections)
    main += section.paper.own_page ? linked_section(section)
                                   : section_html({section, origin, section.paper.folder + "/", "assets/"});
  if (measured)
    main += fmt::format(
        "<h2 id=\"bench\">Speed against accuracy</h2>\n<p><a href=\"{}\">What make bench measured</a>.</p>\n",
        bench_page);
  return app::page_html(parts("Wavebalance: papers reproduced", "assets/",
                              layout(contents(sections, !brief.empty(), measured), main)));
}

std::string own_page_html(const Section& section, const Origin& origin) {
  const std::string main = fmt::format("<p><a href=\"../index.html\">← All results</a></p>\n<h1>{}</h1>\n",
                                       app::escaped(section.paper.name)) +
                           section_html({section, origin, "", "../assets/"});
  return app::page_html(
      parts("Wavebalance: " + section.paper.name, "../assets/",
            layout(contents_box(entry("../index.html", "← All results") + records_contents(section)), main)));
}

}  // namespace wavebalance::report
