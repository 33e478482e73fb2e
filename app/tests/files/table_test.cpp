#include "wavebalance/app/files/table.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/results/record.hpp"

namespace {

using namespace wavebalance::app;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table mixed_table() {
  Table table({"case", "trial", "error", "converged"});
  table.append_row({std::int64_t{1}, std::string("haar"), 0.1, true});
  table.append_row({std::int64_t{2}, std::string("a,\"b\""), nan, false});
  return table;
}

TEST(Table, RefusesWhatDoesNotFit) {
  Table table;
  table.add_column("a", std::vector<double>{1, 2});
  EXPECT_THROW(table.add_column("a", std::vector<double>{1, 2}), std::invalid_argument);
  EXPECT_THROW(table.add_column("b", std::vector<double>{1}), std::invalid_argument);
  EXPECT_THROW(table.append_row({1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(table.numbers("c"), std::out_of_range);
  EXPECT_THROW(mixed_table().numbers("trial"), std::invalid_argument);
}

TEST(Table, TakesVectorsOfEigenAndSelectsRows) {
  Table table;
  table.add_column("a", Eigen::VectorXd::LinSpaced(3, 0.0, 1.0).eval());
  EXPECT_EQ(table.numbers("a"), (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(mixed_table().where("trial", "haar").rows(), 1u);
  EXPECT_EQ(mixed_table().where("converged", "false").numbers("case"), std::vector<double>{2.0});
}

TEST(Csv, StartsWithItsHeaderRow) {
  EXPECT_EQ(csv_text(mixed_table()),
            "case,trial,error,converged\n1,haar,0.1,true\n2,\"a,\"\"b\"\"\",nan,false\n");
}

TEST(Csv, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  Table table = mixed_table();
  for (const double value : {1.0 / 3.0, 5e-324, -1.7976931348623157e308, -0.0, 1e22})
    table.append_row({std::int64_t{3}, std::string("x"), value, true});
  write_csv(folder / "t.csv", table);
  const Table back = read_csv(folder / "t.csv");
  ASSERT_EQ(back.rows(), table.rows());
  EXPECT_EQ(back.columns(), table.columns());
  EXPECT_EQ(back.texts("trial"), table.texts("trial"));
  EXPECT_EQ(back.numbers("converged"), table.numbers("converged"));
  EXPECT_TRUE(std::isnan(back.numbers("error")[1]));
  for (std::size_t i = 2; i < table.rows(); ++i)
    EXPECT_EQ(back.numbers("error")[i], table.numbers("error")[i]);
}

TEST(Csv, MalformedFilesAreErrorsWithTheLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) -> std::string {
    try {
      read_csv(folder.write("t.csv", text));
    } catch (const IoError& error) {
      return error.reason();
    }
    return "no error";
  };
  EXPECT_EQ(message("\n"), "holds no line of column names");
  const std::string why = ", as in the first line (a comma separates cells; decimals take a point)";
  EXPECT_EQ(message("# a comment\na,b\n"), "line 2: 2 cells; expected 1" + why);
  EXPECT_EQ(message("a,b\n1,2\n3\n"), "line 3: 1 cells; expected 2" + why);
  EXPECT_EQ(message("a,b\n\"1,2\n"), "line 2: a quote is not closed");
}

TEST(Json, KeepsTheOrderAndMakesMissingNumbersNull) {
  EXPECT_EQ(json_text(Summary{{"z", true},
                              {"a", nan},
                              {"n", std::int64_t{3}},
                              {"t", std::string("q\"")},
                              {"x", 0.1},
                              {"l", std::vector<double>{1.5, nan}}}),
            "{\n  \"z\": true,\n  \"a\": null,\n  \"n\": 3,\n  \"t\": \"q\\\"\",\n  \"x\": 0.1,\n  \"l\": "
            "[\n    1.5,\n"
            "    null\n  ]\n}\n");
}

TEST(Json, FilesOfARecordArePlainNamesAndOtherFilesHoldNone) {
  const TemporaryFolder folder;
  const auto names = [&](const std::string& text) {
    return files_of_record(folder.write("summary.json", text));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(R"({"version": "1", "files": [{"name": "a.csv"}, {"name": "../b"}, {"name": 3}, 4]})"),
            (Names{"summary.json", "a.csv"}));
  for (const char* other : {"", "[1]", "{", R"({"files": [{"name": "a.csv"}]})", R"({"version": "1"})"})
    EXPECT_EQ(names(other), Names{}) << other;
  EXPECT_EQ(files_of_record(folder / "missing.json"), Names{});
}

TEST(Json, TextThatIsNoUtf8IsReplaced) {
  EXPECT_NO_THROW(json_text(Summary{{"t", std::string("\xff\xfe")}}));
}

}  // namespace
