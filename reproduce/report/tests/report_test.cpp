#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/report/artefact.hpp"

namespace wavebalance::report {
namespace {

Record example() {
  Record record;
  record.identity = {"some_paper", "SP Fig. 1", "A < B & \"C\"", "fig01_example"};
  record.caption = "caption";
  record.files = {"fig01_example.csv", "fig01_example.svg"};
  record.data = {{"fig01_example.csv", "SI", {"a note of the data"}}};
  record.scenes = {{"one.toml", {{"time.functions=8"}}}};
  record.notes = {"a note"};
  record.statements = {{"section 1", "holds", "x < 1", "0.5", Verdict::agrees, "", {}, ""},
                       {"section 2",
                        "fails",
                        "x < 1",
                        "1.5",
                        Verdict::depends,
                        "x is open",
                        {{"x = 2", Verdict::differs, "2", false}},
                        "(b)"}};
  record.statements[1].apart = "elsewhere";
  record.unjudged = {{"section 3", "perhaps", "It names nothing.", ""}};
  record.slips = {{"eq. (1)", "+", "-", "eq. (2)"}};
  record.checks = {{"", "checked", "y < 1", "0.5", true}};
  record.table = {{"a", "b"}, {"1 | <2>", "3"}};
  record.wall_seconds = 0.25;
  record.version = "0.1.0";
  return record;
}

TEST(Record, ReadsBackAsWritten) {
  const Record record = example();
  const Record back = parse_record(record_text(record), "there.json");
  EXPECT_EQ(record_text(back), record_text(record));
  EXPECT_EQ(back.identity.title, record.identity.title);
  ASSERT_EQ(back.statements.size(), 2u);
  EXPECT_EQ(back.statements[0].verdict, Verdict::agrees);
  EXPECT_EQ(back.statements[1].verdict, Verdict::depends);
  ASSERT_EQ(back.statements[1].readings.size(), 1u);
  EXPECT_EQ(back.statements[1].readings[0].name, "x = 2");
  EXPECT_FALSE(back.statements[1].readings[0].of_text);
  EXPECT_EQ(back.statements[1].apart, "elsewhere");
  EXPECT_EQ(back.unjudged.at(0).quote, "perhaps");
  EXPECT_EQ(back.slips.at(0).meant, "-");
  EXPECT_TRUE(back.checks.at(0).passes);
  EXPECT_EQ(back.scenes.at(0).overrides, record.scenes[0].overrides);
}

TEST(Record, OtherTextIsAnErrorThatNamesTheFile) {
  for (const std::string text : {"", "{}", "[1, 2]", "not json"}) {
    try {
      parse_record(text, "there.json");
      FAIL() << text;
    } catch (const app::IoError& error) {
      EXPECT_EQ(error.path(), "there.json");
    }
  }
}

TEST(Artefact, AttachedFilesAreWrittenAndOnlyListedOnesAreLinked) {
  const TemporaryFolder folder;
  Artefact artefact({"some_paper", "SP Fig. 2", "title", "fig02"}, folder.path(), folder.path());
  artefact.attach("series.pvd", "a");
  artefact.attach("series_00.vtu", "b", false);
  artefact.write(0.0);
  EXPECT_EQ(app::read_file(folder / "series_00.vtu"), "b");
  const auto record = folder / "records" / "fig02.json";
  EXPECT_EQ(parse_record(app::read_file(record), record).files, std::vector<std::string>{"series.pvd"});
}

TEST(Artefact, UnitsAndNotesOfItsDataAreInTheRecord) {
  const TemporaryFolder folder;
  Artefact artefact({"some_paper", "SP Fig. 2", "title", "fig02"}, folder.path(), folder.path());
  app::Table table({"a", "b"});
  table.append_row({1.0, 2.0});
  artefact.data(table, "SI", {"a note"});
  artefact.more_data("more", table, "Hz");
  artefact.write(0.0);
  EXPECT_EQ(app::read_file(folder / "fig02.csv"), "a,b\n1,2\n");
  const auto file = folder / "records" / "fig02.json";
  const Record record = parse_record(app::read_file(file), file);
  ASSERT_EQ(record.data.size(), 2u);
  EXPECT_EQ(record.data[0].name, "fig02.csv");
  EXPECT_EQ(record.data[0].units, "SI");
  EXPECT_EQ(record.data[0].notes, std::vector<std::string>{"a note"});
  EXPECT_EQ(record.data[1].name, "fig02_more.csv");
  EXPECT_EQ(record.data[1].units, "Hz");
}

TEST(Artefact, TheDataOfItsCurvesAreWrittenBesideThePicture) {
  const TemporaryFolder folder;
  Artefact artefact({"some_paper", "SP Fig. 2", "title", "fig02"}, folder.path(), folder.path());
  app::Figure figure;
  figure.add_panel().add({"u", std::vector<double>{0, 1}, std::vector<double>{0, 1}});
  artefact.picture(figure);
  artefact.write(0.0);
  const auto script = app::read_file(folder / "fig02.figure.js");
  EXPECT_NE(script.find("[\"fig02\"]"), std::string::npos);
}

TEST(Artefact, AStatementThatDoesNotAgreeNeedsAReasonAndOneThatDependsReadingsThatPart) {
  Artefact artefact({"some_paper", "SP Fig. 2", "title", "fig02"}, "nowhere", "nowhere");
  Statement statement{"section 1", "quote", "x < 1", "2", Verdict::differs, "", {}, ""};
  EXPECT_THROW(artefact.statement(statement), std::logic_error);
  statement.because = "x is large";
  artefact.statement(statement);
  statement.verdict = Verdict::depends;
  EXPECT_THROW(artefact.statement(statement), std::logic_error);
  statement.readings = {{"x = 2", Verdict::differs, "2"}};
  EXPECT_THROW(artefact.statement(statement), std::logic_error);
  statement.readings.push_back({"x = 1", Verdict::agrees, "1"});
  artefact.statement(statement);
}

TEST(Markdown, HoldsOneRowPerLine) {
  app::Table table({"a", "b"});
  table.append_row({std::string("x"), 0.5});
  EXPECT_EQ(markdown_text(text_table(table)), "| a | b |\n| --- | --- |\n| x | 0.5 |\n");
}

TEST(Numbers, AreShort) {
  EXPECT_EQ(number(0.000123456), "1.23·10⁻⁴");
  EXPECT_EQ(number(1.23456e-5), "1.23·10⁻⁵");
  EXPECT_EQ(number(-1e8), "-10⁸");
  EXPECT_EQ(number(123.4, 2), "120");
  EXPECT_EQ(number(99960.0, 4), "99960");
  EXPECT_EQ(number(99960.0, 3), "10⁵");
  EXPECT_EQ(number(2.5e120), "2.5·10¹²⁰");
  EXPECT_EQ(percent(0.0123456), "1.23 %");
  EXPECT_EQ(percent(1.14e-9), "less than 0.001 %");
  EXPECT_EQ(percent(0.0), "0 %");
}

}  // namespace
}  // namespace wavebalance::report
