#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <sstream>

#include "report/report_parts.hpp"
#include "support/chain_files.hpp"
#include "support/command.hpp"
#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace {

using namespace wavebalance::app;
namespace fs = std::filesystem;

TEST(RunReport, ReportTellsWhatWasAskedAndWhatCameOut) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  const Outcome outcome =
      run(folder, {"run", scene, "--output", folder / "out", "--set", "contact.gap=1.1e-3", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string report = read_file(folder / "out" / "report.html");
  for (const char* words : {"<h1>case: Forced response of a bar</h1>", "was solved", "the gap of 1.1 mm",
                            "--set</span> contact.gap=1.1e-3", "The motion is stable",
                            "href=\"response.csv\"", "src=\"response.svg\"", "alt=\""})
    EXPECT_NE(report.find(words), std::string::npos) << words;
  EXPECT_EQ(report.find("<h2>Warnings"), std::string::npos);
}

TEST(RunReport, TheMovingBarOfTheReportIsTheMotionOfTheResponse) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  for (const std::string type : {"forced_response", "time_stepping", "shooting"}) {
    run(folder, {"run", scene, "-o", folder / "out", "--quiet", "--set", "analysis.type=" + type});
    const std::string script = read_file(folder / "out" / "response.motion.js");
    const std::size_t begin = script.find("\"tip\":[") + 7;
    const std::vector<double> response = read_csv(folder / "out" / "response.csv").numbers("displacement_m");
    std::istringstream tip(script.substr(begin, script.find(']', begin) - begin));
    char comma;
    for (std::size_t k = 0; k < 128; ++k) {
      double value = 0.0;
      ASSERT_TRUE(tip >> value) << type << " " << k;
      EXPECT_NEAR(value, response[k * response.size() / 128], 1e-8) << type << " " << k;
      tip >> comma;
    }
  }
}

TEST(RunReport, TablesHaveTheDigitsThatAReaderNeedsAndNoColumnWithoutAValue) {
  Table table({"type", "frequency_Hz", "multiplier_real", "error", "points"});
  const double none = std::numeric_limits<double>::quiet_NaN();
  table.append_row({std::string("fold"), 3.2638993136025434, none, 5.451053181363303e-8, std::int64_t{12}});
  table.append_row({std::string("grazing"), 2.5, none, none, std::int64_t{7}});
  const std::vector<std::vector<std::string>> expected{{"type", "frequency_Hz", "error", "points"},
                                                       {"fold", "3.263899314", "5.45105e-08", "12"},
                                                       {"grazing", "2.5", "", "7"}};
  EXPECT_EQ(shown_rows(table), expected);
}

TEST(RunReport, ReportSaysWhereContactsStandAndWhatOutputsDo) {
  const TemporaryFolder folder;
  write_chain(folder);
  const std::string scene = folder.write(
      "case.toml", with(chain_scene, "[time]", "[[forcing.terms]]\nharmonic = 0\namplitude = 300.0\n[time]"));
  run(folder, {"run", scene, "-o", folder / "out", "--quiet", "--set", "analysis.outputs=[1]", "--set",
               "contact.gap=[1.0, 1e-4]"});
  const std::string motion = read_file(folder / "out" / "report.html");
  for (const char* words : {"At rest under the static loads 1 of 2 contacts is closed",
                            "The vibration of row 1 is ", "src=\"outputs.svg\"", "href=\"outputs.csv\""})
    EXPECT_NE(motion.find(words), std::string::npos) << words;
  run(folder, {"run", scene, "-o", folder / "curve", "--quiet", "--analysis", "frequency_sweep", "--set",
               "analysis.frequency_from=40", "--set", "analysis.frequency_to=50", "--set",
               "contact.gap=[1.0, 1e-4]"});
  EXPECT_NE(read_file(folder / "curve" / "report.html").find("The vibration of contact 2 is at most "),
            std::string::npos);
}

TEST(RunReport, ReportSaysWhatImpactsDo) {
  const TemporaryFolder folder;
  const fs::path scene = fs::path(WAVEBALANCE_SCENES) / "impacts";
  run(folder, {"run", scene / "oscillator.toml", "-o", folder / "once", "--quiet"});
  const std::string once = read_file(folder / "once" / "report.html");
  for (const char* words : {"There is 1 impact in the period of the motion, at up to 1.696 m/s",
                            "the gap of 1 m", "href=\"impacts.csv\""})
    EXPECT_NE(once.find(words), std::string::npos) << words;
  EXPECT_EQ(once.find("There is no contact"), std::string::npos);
  run(folder, {"run", scene / "bar_without_rebound.toml", "-o", folder / "lasts", "--quiet"});
  EXPECT_NE(read_file(folder / "lasts" / "report.html").find("Contact lasts for 8.4 % of the period"),
            std::string::npos);
}

TEST(RunReport, ReportShowsTheMotionsOfACurveBelowTheCurve) {
  const TemporaryFolder folder;
  const fs::path scene = fs::path(WAVEBALANCE_SCENES) / "jones_legrand_2014" / "case2_sweep.toml";
  const Outcome outcome =
      run(folder, {"run", scene, "-o", folder / "out", "--quiet", "--set", "analysis.motion_at=peak"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder / "out" / "motion_peak.svg"));
  const std::string report = read_file(folder / "out" / "report.html");
  const std::size_t curve = report.find("src=\"sweep.svg\""), motion = report.find("src=\"motion_peak.svg\"");
  ASSERT_NE(motion, std::string::npos);
  EXPECT_LT(curve, motion);
  EXPECT_NE(report.find("Instants of contact"), std::string::npos);
}

TEST(RunReport, ReportSaysThatNothingWasFound) {
  const TemporaryFolder folder;
  const fs::path scene = fs::path(WAVEBALANCE_SCENES) / "jones_legrand_2014" / "case2_sweep.toml";
  const Outcome outcome =
      run(folder, {"run", scene, "-o", folder / "out", "--quiet", "--set", "analysis.max_points=5"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  const std::string report = read_file(folder / "out" / "report.html");
  EXPECT_NE(report.find("The curve is not complete (point limit)"), std::string::npos);
  EXPECT_NE(report.find("<h1>case2_sweep: Frequency response of a bar</h1>"), std::string::npos);
}

TEST(RunReport, NoReportLeavesItOutAndRemovesThatOfAnEarlierRun) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("case.toml", bar_scene);
  run(folder, {"run", scene, "-o", folder / "out", "--quiet"});
  EXPECT_TRUE(fs::exists(folder / "out" / "report.html"));
  const Outcome outcome = run(folder, {"run", scene, "-o", folder / "out", "--quiet", "--no-report"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_FALSE(fs::exists(folder / "out" / "report.html"));
  EXPECT_EQ(TemporaryFolder::count(folder / "out"), 4);
}

}  // namespace
