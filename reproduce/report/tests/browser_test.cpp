// The pages in a real browser: chromium without a window opens them in frames, and what it finds is compared
// with the data.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "chromium.hpp"
#include "paper_results.hpp"
#include "wavebalance/app/page/assets.hpp"
#include "wavebalance/report/page.hpp"

namespace wavebalance::report {
namespace {

using Path = std::filesystem::path;

/// What `pages` show in frames of 400, 800 and 1400 px: one object for each of both. `log` has the browser's
/// messages.
nlohmann::json probed(const std::vector<Path>& pages, const Path& folder, std::string& log) {
  return found_by(WAVEBALANCE_PROBE, pages, folder, log);
}

/// Messages of scripts that failed and of files that were not found.
std::string complaints(const std::string& log) {
  std::string found;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != line.npos &&
        (line.find("Uncaught") != line.npos || line.find("Failed to load") != line.npos ||
         line.find("rror:") != line.npos))
      found += line + "\n";
  return found;
}

/// The targets of links and sources of a page that lead nowhere: files that are missing, anchors without an
/// element.
std::set<std::string> broken_links(const Path& page) {
  const std::string text = app::read_file(page);
  std::set<std::string> ids, broken;
  const auto each = [&](const std::string& name, const auto& found) {
    const std::string begin = " " + name + "=\"";
    for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at + 1))
      found(text.substr(at + begin.size(), text.find('"', at + begin.size()) - at - begin.size()));
  };
  each("id", [&](const std::string& id) { ids.insert(id); });
  const auto check = [&](const std::string& target) {
    if (target.starts_with("https://")) return;
    const bool there = target.starts_with("#")
                           ? ids.count(target.substr(1)) > 0
                           : std::filesystem::exists(page.parent_path() / target.substr(0, target.find('#')));
    if (!there) broken.insert(target);
  };
  for (const char* name : {"href", "src", "data-curves", "data-motion", "data-readings", "data-library"})
    each(name, check);
  each("data-bodies", [&](const std::string& list) {
    std::istringstream targets(list);
    for (std::string target; targets >> target;) check(target);
  });
  return broken;
}

void expect_in_order(const std::vector<int>& levels, const std::string& where) {
  ASSERT_FALSE(levels.empty()) << where;
  EXPECT_EQ(levels[0], 1) << where;
  for (std::size_t i = 1; i < levels.size(); ++i)
    EXPECT_LE(levels[i], levels[i - 1] + 1) << where << " heading " << i;
}

/// What must hold of every page.
void expect_sound(const nlohmann::json& found, const std::string& log) {
  EXPECT_EQ(complaints(log), "");
  for (const auto& one : found) {
    ASSERT_FALSE(one.contains("error")) << one["error"];
    const std::string where =
        one["page"].get<std::string>() + " at " + std::to_string(one["width"].get<int>()) + " px";
    EXPECT_LE(one["folded"].get<int>(), 0) << where;
    EXPECT_LE(one["unfolded"].get<int>(), 0) << where << one["tooWide"];
    EXPECT_EQ(one["language"], "en") << where;
    EXPECT_TRUE(one["withoutAlternative"].empty()) << where << one["withoutAlternative"];
    EXPECT_EQ(one["mathLeft"], 0) << where;
    expect_in_order(one["levels"].get<std::vector<int>>(), where);
  }
}

nlohmann::json moving_bar() {
  nlohmann::json data{{"gap", 1e-3}, {"amplitude", 2.0}, {"frequency", 150.0}, {"length", 0.5}};
  const auto motion = [&](const std::string& label, double size) {
    nlohmann::json one{{"label", label}, {"name", label}};
    for (int i = 0; i < 16; ++i) {
      const double tip = size * std::cos(2.0 * std::numbers::pi * i / 16.0) -
                         1e-4 * std::sin(2.0 * std::numbers::pi * i / 16.0);
      one["nodes"].push_back({0.0, 0.5 * tip, tip});
      one["tip"].push_back(tip);
      one["force"].push_back(std::max(0.0, tip / 1e-3 - 1.0));
    }
    return one;
  };
  for (int i = 0; i < 16; ++i) data["time"].push_back(i / 16.0);
  data["pairs"] = {motion("one", 1.2e-3), motion("two", 0.7e-3)};
  data["reference"] = motion("time stepping", 1.1e-3);
  return data;
}

/// Two ways to form sums, under the second of which one curve is missing.
std::string readings_script(const std::string& stem) {
  nlohmann::json data{{"label", "u (mm)"}, {"from", 0.0}, {"to", 1.0}, {"unit", 0.1}, {"level", nullptr}};
  data["reference"] = {0, 5, 10};
  data["pairs"] = {{{"label", "sine"}, {"steps", false}}, {{"label", "half"}, {"steps", true}}};
  const auto verdict = [](const char* word) {
    return nlohmann::json::array({{{"statement", 2}, {"verdict", word}}});
  };
  data["readings"] = {{{"name", "left"},
                       {"ofText", true},
                       {"curves", {{0, 4, 10}, {1, 5, 9}}},
                       {"errors", {0.125, 0.5}},
                       {"verdicts", verdict("agrees")}},
                      {{"name", "middle"},
                       {"ofText", false},
                       {"curves", {{0, 6, 10}, nullptr}},
                       {"errors", {0.25, nullptr}},
                       {"verdicts", verdict("differs")}}};
  return "((window.wavebalance ?\?= {}).readings ?\?= {})[\"" + stem + "\"] = " + data.dump() + ";\n";
}

/// Results with a figure that has all that a page shows, and a table on a page of its own.
void write_results(const Path& results) {
  const Path folder = results / "jones_legrand_2014";
  Artefact artefact({"jones_legrand_2014", "JL14 Fig. 6", "Tip displacement, case 1", "fig06_tip_case1"},
                    folder, folder);
  app::Figure figure;
  figure.columns = 2;
  for (const char* title : {"first", "second"}) {
    std::vector<double> x, y;
    for (int i = 0; i <= 40; ++i) {
      x.push_back(i / 40.0);
      y.push_back(std::sin(2.0 * std::numbers::pi * x.back()));
    }
    auto& panel = figure.add_panel(title);
    panel.x.label = "Time (periods)";
    panel.y.label = "u_{tip} (mm)";
    panel.add({"sine", x, y}).add({"half", x, std::vector<double>(x.size(), 0.5)}).mark_y(0.8, "gap");
  }
  const std::vector<double> three{0.0, 0.5, 1.0}, rising{-0.9, 0.0, 0.9};
  figure.panels.back().add({"dots", three, rising, app::SeriesStyle::line_points});
  artefact.picture(figure);
  artefact.caption("The gap is $g_0 = 1$ mm.");
  artefact.note("A note with a long formula: $\\omega^2 = r + \\langle\\lambda\\rangle g_0 / m$.");
  artefact.statement({"section 5.1", "It holds.", "x < 1", "0.5", Verdict::agrees, "", {}, "(a)", "x < 2"});
  artefact.statement(
      {"section 5.2",
       "It depends on a detail_with_a_name_that_has_no_blank_at_all_where_a_line_could_be_broken.",
       "x < 1",
       "1.5",
       Verdict::depends,
       "x is open",
       {{"x = 1", Verdict::agrees, "1"}, {"x = 2", Verdict::differs, "2"}},
       "(b)",
       ""});
  artefact.check({"", "The code is right.", "error < 1", "0.1", true});
  artefact.attach("motion_case1.json", moving_bar().dump(), false);
  artefact.attach("fig06_tip_case1.readings.js", readings_script("fig06_tip_case1"), false);
  artefact.made_by("jl14 fig06");
  artefact.write(0.1);
  const Path other = results / "extremes";
  Artefact table({"extremes", "Extremes", "inputs", "extremes"}, other, other);
  app::Table wide({"a_rather_long_name_of_a_column_1", "a_rather_long_name_of_a_column_2",
                   "a_rather_long_name_of_a_column_3", "a_rather_long_name_of_a_column_4",
                   "a_rather_long_name_of_a_column_5"});
  wide.append_row({1.0, 2.0, 3.0, 4.0, std::string("$\\omega^2$")});
  table.printed(wide);
  table.caption("A wide table.");
  table.write(0.1);
}

class Browser : public NeedsChromium {};

/// With what `make reproduce` made; CTest says by its name that it was skipped.
class BrowserOfResults : public NeedsChromium {};

TEST_F(Browser, PagesFitThreeWidthsWithoutErrorsAndMoveAsTheirDataSay) {
  const TemporaryFolder folder;
  const Path results = folder.path() / "results";
  write_results(results);
  write_pages(results, Origin{});
  const std::vector<Path> pages{results / "index.html", results / "extremes" / "index.html"};
  for (const Path& page : pages) EXPECT_EQ(broken_links(page), std::set<std::string>{}) << page;
  std::string log;
  const auto found = probed(pages, folder.path(), log);
  ASSERT_EQ(found.size(), 6u) << found.back();
  expect_sound(found, log);

  const auto& whole = found[2];
  ASSERT_TRUE(whole["tips"].is_object()) << whole["tips"];
  EXPECT_TRUE(whole["tips"]["moved"].get<bool>());
  ASSERT_EQ(whole["tips"]["found"].size(), 9u);
  const auto bar = moving_bar();
  for (const auto& one : whole["tips"]["found"]) {
    const int pair = one["pair"];
    const auto& motion = pair < 0 ? bar["reference"] : bar["pairs"][static_cast<std::size_t>(pair)];
    const std::size_t instant =
        (one["position"].get<std::size_t>() + 8) % 16;  // shown from -1/2 to 1/2 of the period
    EXPECT_NEAR(one["tip"].get<double>(), motion["tip"][instant].get<double>(), 1e-9) << one;
  }

  if (!app::available(app::Library::d3)) GTEST_SKIP() << "d3 is not installed (setup installs it)";
  const auto& sums = whole["sums"];
  ASSERT_EQ(sums.size(), 2u) << sums;
  EXPECT_EQ(sums[0]["name"], "1 of 2: left. The text allows it; the figure shows it.");
  EXPECT_EQ(sums[1]["name"], "2 of 2: middle. This is not what the paper does.");
  EXPECT_EQ(sums[0]["titles"], (nlohmann::json{"(a) sine, error 12.5 %", "(b) half, error 50 %"}));
  EXPECT_EQ(sums[1]["titles"], (nlohmann::json{"(a) sine, error 25 %", "(b) half, no solution found"}));
  EXPECT_EQ(sums[0]["verdicts"], nlohmann::json::array({"#fig06_tip_case1-2 statement 2: ✓ agrees"}));
  EXPECT_NE(sums[0]["curves"][0], sums[1]["curves"][0]);
  EXPECT_TRUE(sums[1]["curves"][1].is_null());
  const auto& curves = whole["curves"];
  ASSERT_TRUE(curves.is_object()) << curves;
  std::string values = curves["values"];
  if (const std::size_t minus = values.find("\u2212"); minus != values.npos) values.replace(minus, 3, "-");
  double x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(values.c_str(), "sineTime (periods): %lfutip (mm): %lf", &x, &y), 2) << values;
  EXPECT_NEAR(x, curves["x"].get<double>(), 1e-9);
  EXPECT_NEAR(y, std::sin(2.0 * std::numbers::pi * x), 1e-4);
  EXPECT_EQ(curves["before"], 5);
  EXPECT_EQ(curves["hidden"], 3);
  EXPECT_FALSE(curves["wheel"].get<bool>());
  EXPECT_TRUE(curves["wheelWithCtrl"].get<bool>());
  EXPECT_EQ(curves["snapped"], "dotsTime (periods): 0utip (mm): \u22120.9");
  EXPECT_TRUE(curves["zoomed"].get<bool>());
  EXPECT_TRUE(curves["reset"].get<bool>());
}

TEST_F(Browser, TheReportOfARunIsSoundAndMovesTheBarAsItsResponseSays) {
  const TemporaryFolder folder;
  std::vector<Path> pages;
  for (const std::string scene : {"case1", "case2_sweep"}) {
    const Path output = folder.path() / scene;
    const std::string command = "'" WAVEBALANCE_COMMAND "' run '" WAVEBALANCE_SCENES "/jones_legrand_2014/" +
                                scene + ".toml' --quiet --output '" + output.string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    pages.push_back(output / "report.html");
    EXPECT_EQ(broken_links(pages.back()), std::set<std::string>{}) << pages.back();
  }
  std::string log;
  const auto found = probed(pages, folder.path(), log);
  ASSERT_EQ(found.size(), 6u) << found.back();
  expect_sound(found, log);
  const auto& tips = found[2]["tips"];
  ASSERT_TRUE(tips.is_object()) << tips;
  EXPECT_TRUE(tips["moved"].get<bool>());
  const auto response = app::read_csv(folder.path() / "case1" / "response.csv").numbers("displacement_m");
  constexpr std::size_t instants = 128;
  for (const auto& one : tips["found"]) {
    const std::size_t instant = (one["position"].get<std::size_t>() + instants / 2) % instants;
    EXPECT_NEAR(one["tip"].get<double>(), response[instant * response.size() / instants], 1e-8) << one;
  }
}

TEST_F(Browser, TheReportsOfAComparisonAndOfAnOverlayAreSound) {
  const TemporaryFolder folder;
  const std::string scenes = WAVEBALANCE_SCENES "/jones_legrand_2014/", here = folder.path().string();
  const std::string few = " --pairs fourier:fourier,haar:fourier --budget 2 --quiet --output '" + here;
  const std::string sweep = scenes + "case2_sweep.toml'", one = "'" WAVEBALANCE_COMMAND "' ";
  for (const std::string& command :
       {one + "compare '" + scenes + "case1.toml'" + few + "/forced'",
        one + "compare '" + sweep + few + "/sweep'",
        one + "run '" + sweep + " --quiet --set time.functions=15 --set analysis.motion_at=peak --output '" +
            here + "/curve'",
        one + "overlay '" + here + "/curve' --quiet --output '" + here + "/picture'"})
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  std::vector<Path> pages;
  for (const char* page :
       {"forced/report.html", "sweep/report.html", "curve/report.html", "picture/overlay.html"}) {
    pages.push_back(folder.path() / page);
    EXPECT_EQ(broken_links(pages.back()), std::set<std::string>{}) << page;
  }
  std::string log;
  const auto found = probed(pages, folder.path(), log);
  ASSERT_EQ(found.size(), 12u) << found.back();
  expect_sound(found, log);
}

TEST_F(BrowserOfResults, FindsTheResultsOfTheRunSound) {
  const Path results = WAVEBALANCE_RESULTS;
  if (!std::filesystem::exists(results / "index.html")) GTEST_SKIP() << "make reproduce has not been run";
  for (const char* name : {"page.css", "page.js", "curves.js", "motion.js", "sums.js", "body.js"})
    if (!std::filesystem::exists(results / "assets" / name) ||
        app::read_file(results / "assets" / name) != app::asset(name))
      GTEST_SKIP() << "the results are those of another build: make reproduce";
  std::vector<Path> pages{results / "index.html"};
  for (const Paper& paper : papers())
    if (paper.own_page && std::filesystem::exists(results / paper.folder / "index.html"))
      pages.push_back(results / paper.folder / "index.html");
  for (const Path& page : pages) EXPECT_EQ(broken_links(page), std::set<std::string>{}) << page;
  const TemporaryFolder folder;
  std::string log;
  const auto found = probed(pages, folder.path(), log);
  ASSERT_EQ(found.size(), 3 * pages.size()) << found.back();
  expect_sound(found, log);
  const auto& tips = found.at(2)["tips"];
  ASSERT_TRUE(tips.is_object()) << tips;
  std::string source = tips["source"];
  source = source.substr(0, source.find(".motion.js")) + ".json";
  const auto bar = nlohmann::json::parse(app::read_file(results / source));
  const std::size_t count = bar["time"].size();
  for (const auto& one : tips["found"]) {
    const int pair = one["pair"];
    const auto& motion = pair < 0 ? bar["reference"] : bar["pairs"][static_cast<std::size_t>(pair)];
    const std::size_t instant = (one["position"].get<std::size_t>() + count / 2) % count;
    EXPECT_NEAR(one["tip"].get<double>(), motion["tip"][instant].get<double>(),
                1e-6 * bar["gap"].get<double>())
        << one;
  }
}

}  // namespace
}  // namespace wavebalance::report
