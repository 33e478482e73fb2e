#include "wavebalance/report/page.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "page/page_parts.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::report {
namespace {

Record judged() {
  Record record;
  record.identity = {"some_paper", "SP Fig. 1", "A < B & \"C\"", "fig01_example"};
  record.caption = "caption with $x < 1$";
  record.files = {"fig01_example.csv", "fig01_example.svg", "fig01_example.png"};
  record.data = {{"fig01_example.csv", "in SI units", {"a remark on the data"}}};
  record.scenes = {{"one.toml", {{"time.functions=8", "time.trial=haar"}, {"time.functions=16"}}}};
  record.notes = {"a note"};
  const std::vector<Reading> readings{{"x = 2", Verdict::differs, "2"}, {"x = 1", Verdict::agrees, "1"}};
  record.statements = {{"section 1", "holds", "x < 1", "0.5", Verdict::agrees, "", {}, "", ""},
                       {"section 2", "depends", "x < 1", "1.5", Verdict::depends, "x is open. More.",
                        readings, "(b)", "x < 2"},
                       {"section 3", "fails", "x < 1", "3", Verdict::differs, "x is large", {}, "", ""}};
  record.checks = {{"", "checked", "y < 1", "0.5", true}};
  record.table = {{"a", "b"}, {"1 | <2>", "3"}};
  record.program = "sp fig01";
  record.wall_seconds = 0.25;
  record.version = "0.1.0";
  return record;
}

Paper some_paper(bool own_page = false) {
  return {"some_paper", "Some 2000", "Some 2000, A paper", "https://example.org", "CC BY", own_page, {}};
}

std::string page(const Record& record = judged()) {
  const std::map<std::string, std::uintmax_t> files{
      {"fig01_example.svg", 1000}, {"fig01_example.figure.js", 10}, {"scenes/one.toml", 10}};
  return page_html({{some_paper(), {record}, files}}, {"abc123", "GNU 12", "a processor, 2 cores"});
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Commands as they are copied from a page, whose options are elements of their own.
std::string copied(const std::string& html) {
  return std::regex_replace(html, std::regex("<span class=\"whole\">([^<]*)</span>"), "$1");
}

/// The text of the first section with the id.
std::string section(const std::string& text, const std::string& id) {
  const std::size_t begin = text.find("<section id=\"" + id + "\"");
  return begin == text.npos ? "" : text.substr(begin, text.find("</section>", begin) - begin);
}

/// The values of all attributes of that name.
std::multiset<std::string> attributes(const std::string& text, const std::string& name) {
  std::multiset<std::string> values;
  const std::string begin = " " + name + "=\"";
  for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at + 1)) {
    const std::size_t first = at + begin.size();
    values.insert(text.substr(first, text.find('"', first) - first));
  }
  return values;
}

TEST(Page, EscapesWhatItShows) {
  EXPECT_TRUE(holds(page(), "A &lt; B &amp; &quot;C&quot;"));
  EXPECT_FALSE(holds(page(), "A < B"));
  EXPECT_TRUE(holds(page(), "<span class=\"math\">x &lt; 1</span>"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Page, OpensWithCountsAndSixFindingsThatHoldAndThreeThatDoNot) {
  EXPECT_TRUE(holds(section(page(), "brief"),
                    "Of 3 statements 1 agrees, 1 differs, 1 depends on what the paper leaves open."));
  Record many = judged();
  many.statements[0].headline = "It is 0.5.";
  many.statements[2].headline = "It is 3.";
  for (int i = 0; i < 20; ++i) many.statements.push_back(many.statements[i % 2 == 0 ? 0 : 2]);
  const std::string brief = section(page(many), "brief");
  const std::string list = brief.substr(0, brief.find("</ul>"));
  EXPECT_EQ(count_of(list, "<li>"), 9u);
  EXPECT_EQ(count_of(list, "It is 0.5."), 6u);
  EXPECT_EQ(count_of(list, "It is 3."), 3u);
  EXPECT_LT(list.rfind("It is 0.5."), list.find("It is 3."));
}

TEST(Page, StatementsJudgedApartAreShownAndNotCounted) {
  Record record = judged();
  record.statements[0].apart = "on another body";
  record.statements[0].headline = "It is 0.5.";
  EXPECT_TRUE(holds(section(page(record), "brief"), "Of 2 statements 1 differs, 1 depends"));
  EXPECT_FALSE(holds(section(page(record), "brief"), "It is 0.5."));
  EXPECT_TRUE(holds(section(page(record), "matrix"), "class=\"cell agrees apart\""));
  EXPECT_TRUE(holds(section(page(record), "matrix"), "dashed: on another body, not counted"));
  EXPECT_TRUE(holds(page(record), "agrees · on another body, not counted"));
}

TEST(Page, ReadingsThatTheTextDoesNotAllowStandBesideTheOthers) {
  Record record = judged();
  record.statements[1].readings.push_back({"x = 7", Verdict::agrees, "7", false});
  EXPECT_TRUE(holds(page(record), "depends: 1 of 2 readings of the text · if instead: 1 of 1"));
  EXPECT_TRUE(holds(page(record), "<summary>If instead: 1 of 1 agree</summary>"));
  EXPECT_TRUE(holds(section(page(record), "matrix"), "statement 2: depends\">1/2</a>"));
}

TEST(Page, ListsWhatIsNotJudgedAndAllMisprintsInOnePlace) {
  EXPECT_FALSE(holds(section(page(), "rule"), "misprint of the papers"));
  Record record = judged();
  record.unjudged = {{"section 4", "somehow", "It names nothing.", "2 N"}};
  record.slips = {{"eq. (20)", "1/T", "1/m", "eq. (23)"}};
  record.statements[2].verdict = Verdict::misprint;
  const std::string rule = section(page(record), "rule");
  EXPECT_TRUE(holds(rule, "One sentence that cannot be judged"));
  EXPECT_TRUE(
      holds(rule, "<td>Some 2000, section 4</td><td>somehow</td><td>It names nothing.</td><td>2 N</td>"));
  EXPECT_TRUE(holds(rule, "All 2 misprints of the papers"));
  EXPECT_TRUE(holds(rule, "<td>Some 2000, eq. (20)</td><td>1/T</td><td>1/m</td><td>eq. (23)</td>"));
  EXPECT_TRUE(holds(rule, "<td>Some 2000, section 3</td><td>fails</td>"));
}

TEST(Page, TableOfVerdictsHasARowForEachStatement) {
  Record record = judged();
  record.statements[1].readings.push_back({"x = 7", Verdict::agrees, "7", false});
  const app::Table table = verdicts_table({{some_paper(), {record}, {}}});
  ASSERT_EQ(table.rows(), 3u);
  EXPECT_EQ(std::get<std::string>(table.at(1, "id")), "fig01_example-2");
  EXPECT_EQ(std::get<std::string>(table.at(1, "verdict")), "depends");
  EXPECT_EQ(table.numbers("readings_of_text"), (std::vector<double>{0, 2, 0}));
  EXPECT_EQ(table.numbers("agreeing_of_text"), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(table.numbers("readings_if_instead"), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(verdicts_table({{some_paper(true), {record}, {}}}).rows(), 0u);
}

TEST(Page, MatrixHasOneLinkedCellForEachStatement) {
  const std::string matrix = section(page(), "matrix");
  for (const char* number : {"1", "2", "3"})
    EXPECT_EQ(attributes(matrix, "href").count(std::string("#fig01_example-") + number), 1u);
  EXPECT_TRUE(holds(matrix, "aria-label=\"SP Fig. 1, statement 2: depends\">1/2</a>"));
}

TEST(Page, EveryAnchorExistsOnce) {
  const auto ids = attributes(page(), "id");
  for (const auto& id : ids) EXPECT_EQ(ids.count(id), 1u) << id;
  for (const auto& target : attributes(page(), "href")) {
    if (target.starts_with("#")) {
      EXPECT_EQ(ids.count(target.substr(1)), 1u) << target;
    }
  }
}

TEST(Page, ACardSaysWhatDecidesWhatIsFoundAndWhy) {
  for (const char* part : {"panel (b), section 2", "<dt>Decided by</dt><dd>x &lt; 1</dd>",
                           "<dt>Found</dt><dd>1.5</dd>", "<dt>Because</dt><dd>x is open. More.</dd>",
                           "depends: 1 of 2 readings", "2 readings that the text allows", "<td>x = 2</td>"})
    EXPECT_TRUE(holds(page(), part)) << part;
}

TEST(Page, StatesTheRuleAndWhatWasJudgedOtherwiseEarlier) {
  const std::string rule = section(page(), "rule");
  EXPECT_TRUE(holds(rule, "Values within 10 % of each other tie."));
  EXPECT_TRUE(holds(rule, "<q>depends</q></td><td>x &lt; 2</td>"));
  EXPECT_FALSE(holds(rule, "<q>holds</q>"));
  EXPECT_TRUE(
      holds(rule, "1 were judged by another criterion or had another verdict before, and 0 were not judged"));
  Record record = judged();
  record.statements[0].earlier = not_judged;
  EXPECT_TRUE(holds(section(page(record), "rule"), "verdict before, and 1 were not judged"));
}

TEST(Page, OpensWithWhatIsComparedAndHistoryIsFolded) {
  EXPECT_LT(page().find("sentences of the papers and not their curves"), page().find("id=\"brief\""));
  EXPECT_FALSE(holds(page(), "<dt>Earlier</dt>"));
  const std::string rule = section(page(), "rule");
  EXPECT_LT(rule.find("Criteria and verdicts that have changed"), rule.find("The rule was proposed"));
}

TEST(Page, ReadingsAreOpenWhereTheVerdictDependsOnThem) {
  EXPECT_EQ(count_of(page(), "<details class=\"readings\" open>"), 1u);
  Record record = judged();
  record.statements[1].verdict = Verdict::agrees;
  EXPECT_FALSE(holds(page(record), "<details class=\"readings\" open>"));
}

TEST(Page, HeadsOfTablesMayBreakBetweenWords) {
  Record record = judged();
  record.table.front().front() = "smallest_coefficient_error";
  EXPECT_TRUE(holds(page(record), "<th>smallest coefficient error</th>"));
}

TEST(Page, AnOwnPageDoesNotRepeatItsNameInTheNextHeading) {
  Paper paper = some_paper(true);
  paper.citation = paper.name + ": what is at the edge";
  const std::string own = own_page_html({paper, {judged()}, {}, {}}, Origin{});
  EXPECT_TRUE(holds(own, ">What is at the edge</h2>"));
}

TEST(Page, ChecksAreFoldedAndNotCounted) {
  EXPECT_TRUE(holds(page(), "One check of the code, not counted: it passes"));
  Record failing = judged();
  failing.checks.push_back({"", "checked too", "y < 1", "2", false});
  EXPECT_TRUE(
      holds(page(failing),
            "<details class=\"checks\" open><summary>2 checks of the code, not counted: 1 of 2 fail"));
  EXPECT_TRUE(holds(section(page(failing), "brief"), "Of 3 statements"));
}

TEST(Page, SaysAtEachFigureHowToComputeItAgainAndWhereItComesFrom) {
  for (
      const char* part :
      {"sp fig01 --output results/some_paper",
       "wavebalance run reproduce/scenes/some_paper/one.toml --set time.functions=8 --set time.trial=haar --output DIR",
       "href=\"some_paper/scenes/one.toml\"", "in SI units; a remark on the data", "commit abc123", "GNU 12",
       "a processor, 2 cores", "0.25 s"})
    EXPECT_TRUE(holds(copied(page()), part)) << part;
}

TEST(Page, ManyRunsOfASceneAreGivenByTheirKeysAndValues) {
  Record record = judged();
  record.scenes[0].overrides.clear();
  for (int n = 1; n <= 20; ++n) record.scenes[0].overrides.push_back({"time.functions=" + std::to_string(n)});
  EXPECT_TRUE(
      holds(copied(page(record)), "# 20 runs of this scene, with --set of\n  time.functions = 1, 2, 3"));
  EXPECT_FALSE(holds(copied(page(record)), "--set time.functions=2 "));
}

TEST(Page, ShowsThePictureAndItsCurvesAndLinksThePaper) {
  const auto sources = attributes(page(), "src");
  EXPECT_EQ(sources.count("some_paper/fig01_example.svg"), 1u);
  EXPECT_EQ(attributes(page(), "data-curves").count("some_paper/fig01_example.figure.js"), 1u);
  EXPECT_TRUE(holds(page(), "The paper's own Fig. 1: <a href=\"https://example.org\">"));
}

TEST(Page, ALargeVectorPictureIsShownAsPixels) {
  const std::string text =
      page_html({{some_paper(), {judged()}, {{"fig01_example.svg", 2'000'000}}}}, Origin{});
  EXPECT_EQ(attributes(text, "src").count("some_paper/fig01_example.png"), 1u);
  EXPECT_TRUE(attributes(text, "data-curves").empty());
}

TEST(Page, ResultsWithoutAPaperAreNotQuotedFromOneAndNotJudged) {
  Record record = judged();
  record.statements.clear();
  const std::string own =
      page_html({{{"own", "Further", "Further", "", "", false, {}}, {record}, {}}}, Origin{});
  EXPECT_FALSE(holds(own, "Sentences are quoted"));
  EXPECT_FALSE(holds(own, "id=\"brief\""));
  EXPECT_FALSE(holds(own, "#matrix"));
  EXPECT_TRUE(holds(page(), "Sentences are quoted"));
}

TEST(Page, LinksToASectionWithItsOwnPageInPlaceOfShowingIt) {
  const Section own_section{some_paper(true), {judged()}, {}, {}};
  const std::string index = page_html({own_section}, Origin{}), own = own_page_html(own_section, Origin{});
  EXPECT_TRUE(holds(index, "href=\"some_paper/index.html\""));
  EXPECT_FALSE(holds(index, ">3</td>"));
  EXPECT_TRUE(holds(own, "<td>1 | &lt;2&gt;</td><td class=\"whole\">3</td>"));
  EXPECT_TRUE(holds(own, "href=\"../index.html\""));
  EXPECT_TRUE(holds(own, "href=\"fig01_example.csv\""));
  EXPECT_TRUE(holds(own, "href=\"../assets/page.css\""));
}

TEST(Page, ArtefactsStandInThePapersOrder) {
  std::vector<Record> records(4);
  for (std::size_t i = 0; i < 4; ++i)
    records[i].identity.stem = std::vector<std::string>{"fig01_a", "fig02_b", "rigid", "tab01_c"}[i];
  std::string stems;
  for (const Record& record : ordered(records, {"fig01", "tab01"})) stems += record.identity.stem + " ";
  EXPECT_EQ(stems, "fig01_a tab01_c fig02_b rigid ");
}

TEST(Page, TextsAreShortenedAtABlank) {
  EXPECT_EQ(shortened("one two three", 9), "one two …");
  EXPECT_EQ(shortened("one two", 9), "one two");
}

}  // namespace
}  // namespace wavebalance::report
